// Do the robot's drives answer?
#pragma once

#include <optional>
#include <string>

#include "config/robot.hpp"
#include "firmware/tools/doctor/finding.hpp"
#include "firmware/tools/wheels/node_scan.hpp"

namespace ivo::firmware::doctor {

inline constexpr const char* kDrives = "Drives";  ///< name of their group

/// Of a scan that is done, on interface `can`.
[[nodiscard]] Group drive_checks(const NodeScan& scan, const Robot& robot, const std::string& can);

}  // namespace ivo::firmware::doctor
