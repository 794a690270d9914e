#include "firmware/tools/resume/search_sources.hpp"

#include <algorithm>
#include <string_view>
#include <variant>

#include "firmware/files/text_file.hpp"

namespace ivo::firmware {
namespace {

std::uint64_t fingerprint(std::string_view bytes) noexcept {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char c : bytes) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
  }
  return hash;
}

std::vector<std::string> paths_of(const MissionInputs& inputs) {
  const Mission& mission = inputs.file.mission;
  std::vector<std::string> paths = {inputs.file.path, inputs.map.path, inputs.map.image_path, inputs.map.classes_path};
  if (const ImagePrior* const prior = std::get_if<ImagePrior>(&mission.prior)) {
    paths.push_back(prior->image_path);
  }
  for (const AgentSpec& agent : mission.agents) {
    paths.push_back(agent.robot_path);
    paths.push_back(agent.sub_prior ? agent.sub_prior->image_path : "");
  }
  for (const DriveParameters& drive : inputs.robot.drives) {
    if (std::find(paths.begin(), paths.end(), drive.eds) == paths.end()) {
      paths.push_back(drive.eds);
    }
  }
  std::erase(paths, "");
  return paths;
}

}  // namespace

Result<std::vector<KeptSource>> search_sources(const MissionInputs& inputs) {
  std::vector<KeptSource> sources;
  for (const std::string& path : paths_of(inputs)) {
    const Result<std::string> contents = read_file(path);
    if (!contents) {
      return contents.error();
    }
    sources.push_back({path, fingerprint(contents.value())});
  }
  return sources;
}

std::string changed_source(const std::vector<KeptSource>& kept, const std::vector<KeptSource>& now) {
  for (std::size_t i = 0; i < std::max(kept.size(), now.size()); ++i) {
    if (i >= kept.size() || i >= now.size() || kept[i].fingerprint != now[i].fingerprint) {
      return i < now.size() ? now[i].path : kept[i].path;
    }
  }
  return {};
}

}  // namespace ivo::firmware
