// A table of the sea surface restated for water of another refractive index.
#pragma once

#include "tables/uncertainty_table.h"

namespace albtpu {

// The index that a table was made at: its attribute `refractive_index`, or kRefractiveIndex if it states none.
double IndexOfTable(const UncertaintyTable& table);
bool StatesIndex(const UncertaintyTable& table);

// The table as it would be in water of `index`, 1 to 2. At the table's own index it is the same table, bit for bit.
// Otherwise only its values, its standard errors and its attribute `refractive_index` differ.
//
// The waves are the same in all water; only Snell's law differs. From the refraction at each node follows the
// covariance of the slopes that the beam sees, and from these the errors at the other index. With Gamma(n) for the
// gains and H(n) for the curvature of Snell's law on this sea (EffectiveGainsOf in closed_form.h), along and across the
// beam and of the path, r(n) for the angle in water and V for the slopes:
//  * refraction and THU are of first order, Gamma V Gamma^T. Along and across the beam the ratios of the gains differ,
//    by 0.7 % from 1.33 to 1.36 at 30 degrees, so that each axis needs both.
//  * TVU is of first order away from nadir, cos^2 r Gamma_3 V Gamma_3^T, and of second order at nadir, where it is
//    1/2 cos^2 r tr(H V H V) and twice as sensitive to the index. The part of second order is that of the table's
//    vertical beam, times the ratio of the curvatures; the rest is of first order.
//  * At depth 0 all is of first order: height times slope.
//  * Biases are in the ratio of the mean of Snell's law over the slopes of the whole sea less its value on a level sea.
// The slopes of the whole sea, on which gains depend by some 0.1 % between indices, are those by which the table has
// its vertical bias, or its refraction under the narrowest beam if it has no biases.
//
// From 1.33 to 1.36, and to any index between, all of them agree with the response theory computed at that index within
// 0.1 % over wind seas (docs/physics.md, "Another index").
UncertaintyTable AtIndex(UncertaintyTable table, double index);

}  // namespace albtpu
