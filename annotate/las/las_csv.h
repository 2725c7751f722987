// The points of a LAS file as CSV: time, place, uncertainty and class of each, in the order of the file.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "annotate/las/las_place.h"
#include "formats/las/las_extra_bytes.h"
#include "formats/las/las_points.h"

namespace albtpu::annotate {

class LasCsv {
 public:
  LasCsv(const formats::LasHeader& header, const LasPlace& place, const formats::Appended& appended);

  // "gps_time [s],x [m],y [m],z [m],total_thu [m; 2 sigma],total_tvu [m; 2 sigma],class". Times and places are those of
  // the file, in its units.
  const std::string& head() const { return head_; }

  // A line for each of `count` records of the file, behind each of which THU and TVU begin the appended bytes. A number
  // that is not known is an empty cell.
  void Append(std::string_view annotated, std::size_t count, std::size_t record_length, std::size_t annotated_length,
              std::string& text) const;

 private:
  formats::LasPointFields fields_;
  std::array<int, 3> decimals_;  // Of coordinates, after which all digits are 0; negative: as many as they need.
  std::string head_;
};

}  // namespace albtpu::annotate
