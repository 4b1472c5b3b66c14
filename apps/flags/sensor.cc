// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/sensor.h"

#include <gflags/gflags.h>

#include <string>
#include <utility>
#include <vector>

#include "apps/run/flag.h"
#include "icpscape/common/text.h"

static const icpscape::FlagGroup group(__FILE__, "Input: the place of the sensor");

DEFINE_string(sensor_origin, "",
              "Where the sensor is in the frame of each scan: x,y,z (m). Normals look there, and "
              "lerp_slerp is the path of this point. By default what a PCD file says as its "
              "VIEWPOINT, else 0,0,0.");

namespace icpscape {

std::optional<Vec3> SensorFromFlags() {
  if (FLAGS_sensor_origin.empty()) {
    return std::nullopt;
  }
  const std::vector<std::string> parts = Split(FLAGS_sensor_origin);
  Vec3 sensor = Vec3::Zero();
  for (std::size_t axis = 0; axis < 3 && axis < parts.size(); ++axis) {
    sensor[static_cast<Eigen::Index>(axis)] = ParseNumber(parts[axis]);
  }
  RequireFlag(parts.size() == 3 && sensor.allFinite(), "sensor_origin", FLAGS_sensor_origin,
              "three numbers, as in 0.5,0,1.7");
  return sensor;
}

void PlaceSensors(ScanSequence* sequence) {
  const std::optional<Vec3> sensor = SensorFromFlags();
  if (!sensor) {
    return;
  }
  for (Scan& scan : sequence->scans) {
    scan.read = [read = std::move(scan.read), sensor = *sensor](DroppedPoints* dropped) {
      PointCloud cloud = read(dropped);
      cloud.sensor = sensor - cloud.origin;
      return cloud;
    };
  }
}

}  // namespace icpscape
