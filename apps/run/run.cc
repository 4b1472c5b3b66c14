// SPDX-License-Identifier: BSD-3-Clause
#include "apps/run/run.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <utility>

#include "apps/run/app.h"
#include "apps/run/figures.h"
#include "apps/run/interrupt.h"
#include "apps/run/run_flags.h"
#include "icpscape/common/text.h"
#include "icpscape/io/output.h"

namespace icpscape {
namespace {

constexpr char kManifest[] = "manifest.json";

std::vector<std::string> ReadLines(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

// Whether a name read from a file stays within the folder.
bool IsInside(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(name).lexically_normal();
  return !path.empty() && path.is_relative() && *path.begin() != "..";
}

void RecordFlags(Manifest* manifest) {
  for (const Flag& flag : OwnFlags()) {
    manifest->SetFlag(flag.name, flag.value, flag.IsChanged() && !flag.Has(kAside));
  }
}

}  // namespace

Run::Run() : folder_(OutFromFlags()), figures_(FigureFormatsFromFlags()), manifest_(AppName()) {
  PrepareOutputFolder(folder_);
  list_ = folder_ / ("." + AppName() + ".written");
  stale_ = ReadLines(list_);
  if (const auto earlier = FilesOfManifest(folder_ / kManifest, AppName())) {
    stale_.insert(stale_.end(), earlier->begin(), earlier->end());
    WriteTextFile(list_, Join(stale_, "\n") + "\n");
    std::filesystem::remove(folder_ / kManifest);
  }
  RecordFlags(&manifest_);
}

void Run::BeginWriting() {
  for (const std::string& name : stale_) {
    std::error_code error;
    if (IsInside(name) && !std::filesystem::is_directory(folder_ / name, error)) {
      std::filesystem::remove(folder_ / name, error);
    }
  }
  stale_.clear();
}

std::filesystem::path Run::File(const std::string& name) {
  BeginWriting();
  if (std::find(files_.begin(), files_.end(), name) == files_.end()) {
    files_.push_back(name);
    WriteTextFile(list_, Join(files_, "\n") + "\n");
    std::filesystem::create_directories((folder_ / name).parent_path());
  }
  return folder_ / name;
}

std::filesystem::path Run::Lasting(const std::string& name) {
  lasting_.push_back(name);
  SetAdviceAfterInterrupt("the next run goes on from " + name);
  return folder_ / name;
}

void Run::Draw(const std::string& script, std::vector<std::string> arguments,
               const std::string& figure) {
  BeginWriting();
  if (!figure.empty()) {  // Of a run that kept no list.
    std::filesystem::remove(folder_ / (figure + ".svg"));
    std::filesystem::remove(folder_ / (figure + ".png"));
  }
  if (figures_ == FigureFormats::kNone) {
    return;
  }
  const ScratchFolder scratch(folder_ / (".figures." + std::to_string(getpid())));
  arguments.insert(arguments.end(),
                   {"--out", (scratch.path() / figure).string(), "--formats", NameOf(figures_)});
  if (!RunPlotScript(script, arguments)) {
    return;
  }
  std::vector<std::filesystem::path> drawn;
  for (const auto& entry : std::filesystem::directory_iterator(scratch.path())) {
    drawn.push_back(entry.path());
  }
  std::sort(drawn.begin(), drawn.end());
  for (const std::filesystem::path& path : drawn) {
    std::filesystem::rename(path, File(path.filename().string()));
  }
}

// "out/curves.csv, landscape.png, data/ (24 files), manifest.json".
std::string Run::WrittenText() const {
  constexpr int kMostOfOneFolder = 3;
  std::vector<std::string> names = files_;
  names.insert(names.end(), lasting_.begin(), lasting_.end());
  std::map<std::string, int> count;
  for (const std::string& name : names) {
    ++count[std::filesystem::path(name).parent_path().string()];
  }
  std::vector<std::string> parts;
  for (const std::string& name : names) {
    const std::string parent = std::filesystem::path(name).parent_path().string();
    const bool is_many = !parent.empty() && count[parent] > kMostOfOneFolder;
    const std::string part =
        is_many ? parent + "/ (" + std::to_string(count[parent]) + " files)" : name;
    if (std::find(parts.begin(), parts.end(), part) == parts.end()) {
      parts.push_back(part);
    }
  }
  parts.emplace_back(kManifest);
  return (folder_ / Join(parts)).string();
}

void Run::Finish() {
  BeginWriting();
  manifest_.SetFiles(files_);
  manifest_.Write(folder_ / kManifest);
  std::filesystem::remove(list_);
  std::cout << "\ntime: " << manifest_.TimingsText() << "\nwritten: " << WrittenText() << std::endl;
}

}  // namespace icpscape
