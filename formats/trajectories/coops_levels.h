// Water levels as NOAA's Center for Operational Oceanographic Products and Services (CO-OPS) delivers them: from its
// interface for data in CSV, JSON or XML, of observations and predictions, and the table of its page of a station.
//
//     Date Time, Water Level, Sigma, O or I (for verified), F, R, L, Quality
//     2016-05-11 14:00,0.213,0.003,0,0,0,0,v
//
//     {"metadata":{"id":"8723214","name":"Virginia Key", ...},"data":[{"t":"2016-05-11 14:00", "v":"0.213", ...}]}
//
//     <data><metadata id="8723214" name="Virginia Key" .../><observations>
//     <wl t="2016-05-11 14:00" v="0.213" s="0.003" f="0,0,0,0" q="v"/></observations></data>
//
//     "Date","Time (GMT)","Predicted (m)","Preliminary (m)","Verified (m)"
//     "2016/05/11","14:00","0.301","-","0.213"
//
// None of them states the datum. The first three state neither time zone nor unit: these are as they were asked for.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/crs/foot.h"

namespace albtpu::formats {

struct CoopsLevel {
  double time = 0;  // GPS time, s since 1980, if the zone of the file is UTC.
  double level = 0;
};

struct CoopsLevels {
  std::vector<CoopsLevel> levels;  // In order of the file.
  std::string station;             // "8723214 Virginia Key"; may be empty.
  std::optional<double> metres;    // Of the unit; absent: not stated.
  enum class Zone { kAbsent, kGmt, kLocal } zone = Zone::kAbsent;
  std::size_t preliminary = 0, missing = 0;
  bool predicted = false;  // By the tide alone, not measured.
};

// Whether a text is one of these, by its beginning.
bool AreCoopsLevels(std::string_view text);

// Requires AreCoopsLevels(). `name` is for messages. Gaps, which the service fills with empty values, are left out.
absl::StatusOr<CoopsLevels> ReadCoopsLevels(const std::string& name, std::string_view text);

}  // namespace albtpu::formats
