// Covariances of the slopes under a footprint, first and second order, along and across the azimuth of the beam.
#pragma once

#include <Eigen/Core>

#include "sea/response/beam_spectrum.h"
#include "sea/response/footprint_kernel.h"
#include "sea/response/lag_covariances.h"

namespace albtpu {

// Of the slope averaged over the footprint: V.
Eigen::Matrix2d FootprintSlopes(const BeamSpectrum& spectrum, const FootprintKernel& footprint);

// Half the mean square of the difference of the heights of two points of the footprint, m^2.
double HeightDifference(const BeamSpectrum& spectrum, const FootprintKernel& footprint);

// The means over pairs of points of the footprint of products of the elements (along, along), (along, across) and
// (across, across) of R, the covariance of the slopes at the two points.
Eigen::Matrix3d SlopePairs(const LagProducts& products, double incidence, const FootprintKernel& footprint);

// The mean of tr(G R H R).
double MeanOfForms(const Eigen::Matrix2d& g, const Eigen::Matrix2d& h, const Eigen::Matrix3d& pairs);

}  // namespace albtpu
