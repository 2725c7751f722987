// A number that a total takes, and where it comes from.
#pragma once

#include <string>

namespace albtpu::annotate {

struct StatedNumber {
  std::string name, value, source;  // "scan", "0.02 degree", "riegl-vq-880-g: cBLUE 4.2"
  bool assumed = false;             // By albtpu, where neither the user nor the sensor's file says it.
};

}  // namespace albtpu::annotate
