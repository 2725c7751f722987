// Where a green laser finds the surface of the water: below it. The echo that locates the surface is the glint and the
// light that the first decimetres of water scatter back (Guenther 1985; Zhao et al. 2017, doi:10.3390/rs9050426: near
// water surface penetration). An infrared laser is absorbed and has the glint alone.
//
// By single scattering, with the path s in water, the pulse p, the glint F and the scattering back beta,
//
//     echo(t) = F p(t) + beta integral of p(t - 2 n_g s / c) exp(-2 K s) ds,
//
// which depends on the incidence by no more than its scale. docs/physics.md, "The green surface", derives what follows.
#pragma once

#include "budget/water/water_optics.h"
#include "budget/water/water_receiver.h"

namespace albtpu {

// m, of the range in air by which the surface is found too far, along the beam. The glint is not known. Over surveys
// the mean delay is taken as uniform, from that of no glint to none. Within a survey glints are exponential: few facets
// of the water shine, each by chance.
struct GreenSurface {
  double mean = 0;     // over all surveys; a bias
  double unknown = 0;  // 1 sigma of the mean over one survey
  double spread = 0;   // 1 sigma from pulse to pulse within a survey
};

// The detector is kPeak or kHalf: a centroid of all the light that water scatters back lies metres deep, and says more
// of where the receiver stops than of the surface. The field of view does not matter. About 20 ms.
//
//     GreenSurfaceOf(*OpticsOf({.kd = 0.3, .kd_kind = KdKind::kSystem}), {.detector = EchoDetector::kHalf,
//                                                                         .pulse_length = 1.5})
GreenSurface GreenSurfaceOf(const WaterOptics& optics, const WaterReceiver& receiver);

// m, of the range in air, where the glint is `glint` times c beta / (2 n_g) [ns], 0 or more; infinity: nothing else.
// `attenuation` is K, 1/m, above 0: a + B b of a water of absorption a that scatters the fraction B of b backwards.
double GreenSurfaceDelay(double glint, double attenuation, const WaterReceiver& receiver);

// How the reported point moves for each metre by which the surface is found too far along the beam: outwards, and down.
// The beam enters the water so much later, and the measured time leaves 1/n of it less of the path in water.
// `incidence` in rad.
struct ShiftBySurface {
  double along = 0, down = 0;
};
ShiftBySurface ShiftBySurfaceOf(double incidence, double index);

}  // namespace albtpu
