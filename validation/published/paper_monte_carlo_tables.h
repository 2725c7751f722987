// The numbers of Table 3, Figures 8 and 9 and Eq. 27-28 beside ours, as tables.
#pragma once

#include "validation/published/paper_monte_carlo.h"
#include "validation/report/study.h"

namespace albtpu {

DataTable Table3(const PaperMonteCarlo& runs);
DataTable LinesInWind(const PaperMonteCarlo& runs);
DataTable AngleModels(const PaperMonteCarlo& runs);  // Eq. 27 and 28
DataTable Figure8(const PaperMonteCarlo& runs);
DataTable Figure9(const PaperMonteCarlo& runs);

}  // namespace albtpu
