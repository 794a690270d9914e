#include "firmware/tools/colonies.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <limits>
#include <new>
#include <string>
#include <thread>

namespace ivo::firmware {
namespace {

constexpr planner::Budget kPart{100'000};
constexpr std::chrono::milliseconds kSlice{20};

constexpr std::size_t kSearchMegabytes = (sizeof(planner::Search) + 999'999) / 1'000'000;

std::uint64_t available_kilobytes() {
  std::ifstream file("/proc/meminfo");
  std::string key;
  std::uint64_t kilobytes = 0;
  for (std::string unit; file >> key >> kilobytes; std::getline(file, unit)) {
    if (key == "MemAvailable:") {
      return kilobytes;
    }
  }
  return std::numeric_limits<std::uint64_t>::max();  // unknown: the allocation decides
}

Error no_memory(int count) {
  return {"--threads: no memory for " + std::to_string(count) + " colonies; expected " +
          std::to_string(kSearchMegabytes) + " MB for each after the first, or fewer of them"};
}

bool reached(const planner::Progress& progress, int generation) {
  return progress.done || progress.generation >= generation;
}

/// Parts of a fixed size, so that a colony comes to `generation` in the same state however its slices fall in time.
void search_until(planner::Search& search, int generation) {
  const auto end = std::chrono::steady_clock::now() + kSlice;
  while (!reached(search.progress(), generation) && std::chrono::steady_clock::now() < end) {
    search.step(kPart);
  }
}

}  // namespace

Result<Colonies> Colonies::create(planner::Planner& planner, int count) {
  IVO_CONTRACT(count >= 1 && count <= kMost);
  Colonies colonies(planner);
  const auto others = static_cast<std::uint64_t>(count - 1);
  if (others > 0 && others * kSearchMegabytes * 1000 > available_kilobytes()) {
    return no_memory(count);
  }
  for (std::uint64_t i = 0; i < others; ++i) {
    std::unique_ptr<planner::Search> search(new (std::nothrow) planner::Search(planner.world()));
    if (search == nullptr) {
      return no_memory(count);
    }
    colonies.searches_.push_back(search.get());
    colonies.others_.push_back(std::move(search));
  }
  return colonies;
}

void Colonies::start() {
  planner::ColonyParameters parameters = planner_->parameters();
  planner::Rng seeds(parameters.seed);
  for (const std::unique_ptr<planner::Search>& other : others_) {
    parameters.seed = seeds.next();
    other->start(parameters);
  }
  next_exchange_ = kExchange;
}

planner::Progress Colonies::search_on() {
  {
    std::vector<std::jthread> threads;
    for (const std::unique_ptr<planner::Search>& other : others_) {
      threads.emplace_back([&search = *other, generation = next_exchange_] { search_until(search, generation); });
    }
    search_until(*searches_.front(), next_exchange_);
  }
  const bool all_there = std::all_of(searches_.begin(), searches_.end(), [&](const planner::Search* search) {
    return reached(search->progress(), next_exchange_);
  });
  if (all_there) {
    exchange();
  }
  return progress();
}

void Colonies::exchange() {
  const planner::Search& teacher = *searches_[best()];
  for (const std::unique_ptr<planner::Search>& other : others_) {
    if (other.get() != &teacher) {
      other->learn_from(teacher);
    }
  }
  next_exchange_ += std::min(kExchange, std::numeric_limits<int>::max() - next_exchange_);
}

planner::Progress Colonies::progress() const {
  planner::Progress all = searches_[best()]->progress();
  for (const planner::Search* search : searches_) {
    const planner::Progress one = search->progress();
    all.generation = std::min(all.generation, one.generation);
    all.done = all.done && one.done;
  }
  return all;
}

// The lowest number among equals.
std::size_t Colonies::best() const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < searches_.size(); ++i) {
    if (better(searches_[i]->progress(), searches_[best]->progress())) {
      best = i;
    }
  }
  return best;
}

// As the planner ranks plans: search.hpp.
bool Colonies::better(const planner::Progress& a, const planner::Progress& b) const {
  if (!a.has_plan || !b.has_plan) {
    return a.has_plan && !b.has_plan;
  }
  if (a.best.complete != b.best.complete) {
    return a.best.complete;
  }
  if (!a.best.complete) {
    return a.best.unseen_mass < b.best.unseen_mass;
  }
  if (planner_->belief().has_sub_priors) {
    return a.best.expected_sub_prior_time_s < b.best.expected_sub_prior_time_s;
  }
  return planner_->parameters().profile == planner::Profile::kPaper
             ? a.best.expected_time_s < b.best.expected_time_s
             : a.best.expected_time_continuous_s < b.best.expected_time_continuous_s;
}

}  // namespace ivo::firmware
