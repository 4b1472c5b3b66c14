// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/dataset.h"

#include <array>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "icpscape/cloud/scan_sequence.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/io/kitti_writer.h"
#include "icpscape/io/output.h"
#include "icpscape/io/point_files.h"
#include "icpscape/io/sha256.h"

namespace icpscape {
namespace {

using Json = nlohmann::ordered_json;

// Folders of files that each scan has.
constexpr const char* kKinds[] = {"velodyne", "labels", "rings", "times", "ply"};

// KITTI's camera looks forward with x right and y down, 0.27 m ahead of the lidar and 0.08 m below
// it [Geiger et al. 2013, fig. 3].
SE3d CameraFromLidar() {
  Mat3 R;
  R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return SE3d(R, Vec3(0, -0.08, -0.27));
}

std::string ScanName(int index, const char* extension) {
  std::array<char, 24> name;
  std::snprintf(name.data(), name.size(), "%06d.%s", index, extension);
  return name.data();
}

// What an earlier run recorded; empty where it did not, or of other parameters.
Json ReadRecord(const std::filesystem::path& path, const std::string& parameters) {
  std::ifstream in(path);
  const Json record = Json::parse(in, nullptr, false);
  const bool usable = record.is_object() && record.contains("parameters") &&
                      record["parameters"].is_string() && record["parameters"] == parameters &&
                      record.contains("files") && record["files"].is_object();
  return usable ? record["files"] : Json::object();
}

bool IsWhole(const std::filesystem::path& folder, const std::string& name, const Json& files) {
  return files.contains(name) && files[name].is_string() &&
         std::filesystem::exists(folder / name) && Sha256(folder / name) == files[name];
}

// Measured and simulated data must not mix: in the wrong folder a scene could come among KITTI's,
// or overwrite its poses.
void RefuseForeignSequences(const std::filesystem::path& root) {
  const auto refuse_unless_simulated = [&](const std::string& sequence,
                                           const std::filesystem::path& place) {
    if (!std::filesystem::exists(root / "sequences" / sequence / "simulation.json")) {
      throw InputError(place.string() +
                       ": holds data that were not simulated here; expected another folder.");
    }
  };
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(root / "sequences", error)) {
    if (!std::filesystem::is_empty(entry.path(), error)) {
      refuse_unless_simulated(entry.path().filename().string(), entry.path());
    }
  }
  for (const auto& entry : std::filesystem::directory_iterator(root / "poses", error)) {
    refuse_unless_simulated(entry.path().stem().string(), entry.path());
  }
}

// Scans of an earlier, longer run would stand beside poses that do not know them.
void RemoveSurplus(const std::filesystem::path& folder, const Json& files) {
  for (const char* kind : kKinds) {
    std::error_code error;
    std::vector<std::filesystem::path> surplus;
    for (const auto& entry : std::filesystem::directory_iterator(folder / kind, error)) {
      if (!files.contains(std::string(kind) + "/" + entry.path().filename().string())) {
        surplus.push_back(entry.path());
      }
    }
    for (const std::filesystem::path& path : surplus) {
      std::filesystem::remove(path);
    }
  }
}

void PrepareFolders(const DatasetOptions& options, const std::filesystem::path& folder) {
  RefuseForeignSequences(options.root);
  PrepareOutputFolder(options.root / "poses");
  for (const std::string kind : kKinds) {
    if ((kind != "ply" || options.ply) && (kind != "times" || options.point_times)) {
      PrepareOutputFolder(folder / kind);
    }
  }
}

}  // namespace

DatasetSummary WriteDataset(const DatasetOptions& options, const std::vector<SE3d>& T_world_lidar,
                            const std::function<PointCloud(int)>& scan,
                            const std::function<void(int)>& progress) {
  const std::filesystem::path folder = options.root / "sequences" / options.name;
  const std::filesystem::path record_path = folder / "simulation.json";
  PrepareFolders(options, folder);
  const Json known = ReadRecord(record_path, options.parameters);
  Json record = {{"parameters", options.parameters}, {"files", Json::object()}};
  const auto write_record = [&] { WriteTextFile(record_path, record.dump(1) + "\n"); };
  if (known.empty()) {
    // From here on the folder is ours, and what it held is not valid.
    write_record();
    for (const char* kind : kKinds) {
      std::filesystem::remove_all(folder / kind);
    }
    PrepareFolders(options, folder);
  }
  DatasetSummary summary;
  std::string times;
  const int count = static_cast<int>(T_world_lidar.size());
  for (int i = 0; i < count; ++i) {
    std::vector<std::string> names = {"velodyne/" + ScanName(i, "bin"),
                                      "labels/" + ScanName(i, "label"),
                                      "rings/" + ScanName(i, "ring")};
    if (options.point_times) {
      names.push_back("times/" + ScanName(i, "time"));
    }
    if (options.ply) {
      names.push_back("ply/" + ScanName(i, "ply"));
    }
    bool whole = true;
    for (const std::string& name : names) {
      whole = whole && IsWhole(folder, name, known);
    }
    if (whole) {
      ++summary.kept;
    } else {
      const PointCloud cloud = scan(i);
      WriteVelodyne(folder / names[0], cloud);
      WriteLabels(folder / names[1], cloud);
      WriteRings(folder / names[2], cloud);
      if (options.point_times) {
        WritePointTimes(folder / names[3], cloud);
      }
      if (options.ply) {
        WritePly(folder / names.back(), cloud);
      }
      ++summary.simulated;
    }
    for (const std::string& name : names) {
      record["files"][name] = whole ? known[name] : Json(Sha256(folder / name));
    }
    constexpr int kRecordEvery = 20;
    if (summary.simulated % kRecordEvery == kRecordEvery - 1) {
      write_record();
    }
    times += Number(i * kScanPeriodS) + "\n";
    if (progress) {
      progress(i + 1);
    }
  }
  RemoveSurplus(folder, record["files"]);
  WriteTextFile(folder / "times.txt", times);
  WriteKittiCalibration(folder / "calib.txt", CameraFromLidar());
  WriteKittiPoses(options.root / "poses" / (options.name + ".txt"), T_world_lidar,
                  CameraFromLidar());
  write_record();
  return summary;
}

}  // namespace icpscape
