#include "firmware/web/ros/ros_services.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "firmware/web/ros/ros_topics.hpp"

namespace ivo::firmware::web {
namespace {

constexpr std::string_view kTrigger = "std_srvs/Trigger";
constexpr std::string_view kFoundService = "/ivo/found";

constexpr std::array<std::pair<std::string_view, RosAsk>, 13> kTriggers = {{
    {"/ivo/init", RosAsk::kInit},
    {"/ivo/replan", RosAsk::kReplan},
    {"/ivo/enough", RosAsk::kEnough},
    {"/ivo/accept", RosAsk::kAccept},
    {"/ivo/start", RosAsk::kStart},
    {kFoundService, RosAsk::kFound},
    {"/ivo/stop", RosAsk::kStop},
    {"/ivo/end", RosAsk::kEnd},
    {"/ivo/clear_fault", RosAsk::kClearFault},
    {"/ivo/take_control", RosAsk::kTakeControl},
    {"/ivo/release_control", RosAsk::kReleaseControl},
    {"/ivo/give_control", RosAsk::kGiveControl},
    {"/ivo/keep_control", RosAsk::kKeepControl},
}};

constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kRosapi = {{
    {"/rosapi/topics", "rosapi/Topics"},
    {"/rosapi/topic_type", "rosapi/TopicType"},
    {"/rosapi/topics_for_type", "rosapi/TopicsForType"},
    {"/rosapi/services", "rosapi/Services"},
    {"/rosapi/service_type", "rosapi/ServiceType"},
    {"/rosapi/services_for_type", "rosapi/ServicesForType"},
    {"/rosapi/nodes", "rosapi/Nodes"},
    {"/rosapi/get_param_names", "rosapi/GetParamNames"},
    {"/rosapi/get_time", "rosapi/GetTime"},
}};

using NamedServices = std::vector<std::pair<std::string, std::string_view>>;

NamedServices all_services(const RosMission* mission) {
  NamedServices services;
  for (const auto& [name, what] : kTriggers) {
    services.emplace_back(name, kTrigger);
  }
  if (mission != nullptr) {
    for (const RosAgent& agent : mission->agents) {
      services.emplace_back(std::string(kFoundService) + "/" + agent.token, kTrigger);
    }
  }
  for (const auto& [name, type] : kRosapi) {
    services.emplace_back(name, type);
  }
  return services;
}

template <class Named, class Wanted>
void write_names(ValueWriter& writer, std::string_view key, const Named& all, const Wanted& wanted) {
  writer.begin_list(key);
  for (const auto& [name, type] : all) {
    if (wanted(type)) {
      writer.text(name);
    }
  }
  writer.end_list();
}

template <class Named>
std::string_view type_in(const Named& all, std::string_view wanted) {
  for (const auto& [name, type] : all) {
    if (name == wanted) {
      return type;
    }
  }
  return {};
}

}  // namespace

std::optional<RosTrigger> trigger_named(std::string_view name) {
  for (const auto& [known, what] : kTriggers) {
    if (name == known) {
      return RosTrigger{what, std::nullopt};
    }
  }
  if (name.size() > kFoundService.size() + 1 && name.starts_with(kFoundService) && name[kFoundService.size()] == '/') {
    return RosTrigger{RosAsk::kFound, std::string(name.substr(kFoundService.size() + 1))};
  }
  return std::nullopt;
}

bool is_rosapi(std::string_view name) { return !type_in(kRosapi, name).empty(); }

Result<void> write_rosapi(ValueWriter& writer, std::string_view name, const Json& args, const RosMission* mission,
                          const RosStamp& stamp) {
  const auto argument = [&](const char* key) {
    const Json* const value = args.member(key);
    return value != nullptr && value->kind == Json::Kind::kText ? value->text : std::string();
  };
  const auto any = [](std::string_view) { return true; };
  const auto of_type = [wanted = short_type(argument("type"))](std::string_view type) { return type == wanted; };
  for (const auto& [service, key] : {std::pair{"/rosapi/topic_type", "topic"},
                                     {"/rosapi/topics_for_type", "type"},
                                     {"/rosapi/service_type", "service"},
                                     {"/rosapi/services_for_type", "type"}}) {
    if (name == service && argument(key).empty()) {
      return Error{std::string("args: ") + key + ": missing; expected a text"};
    }
  }
  const std::vector<NamedTopic> topics = all_topics(mission);
  const NamedServices services = all_services(mission);
  writer.begin_object();
  if (name == "/rosapi/topics") {
    write_names(writer, "topics", topics, any);
    writer.begin_list("types");
    for (const NamedTopic& topic : topics) {
      writer.text(topic.type);
    }
    writer.end_list();
  } else if (name == "/rosapi/topics_for_type") {
    write_names(writer, "topics", topics, of_type);
  } else if (name == "/rosapi/topic_type") {
    writer.add("type", type_in(topics, argument("topic")));
  } else if (name == "/rosapi/services") {
    write_names(writer, "services", services, any);
  } else if (name == "/rosapi/services_for_type") {
    write_names(writer, "services", services, of_type);
  } else if (name == "/rosapi/service_type") {
    writer.add("type", type_in(services, argument("service")));
  } else if (name == "/rosapi/nodes") {
    writer.begin_list("nodes").text("/ivo");
    writer.end_list();
  } else if (name == "/rosapi/get_param_names") {
    writer.begin_list("names").end_list();
  } else {
    write_time(writer, "time", stamp);
  }
  writer.end_object();
  return {};
}

}  // namespace ivo::firmware::web
