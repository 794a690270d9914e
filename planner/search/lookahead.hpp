// A receding horizon: of the sequences of a few moves that follow the most promising edges, the one that shows most new
// mass, what it shows late counting less; its first move is taken. Sees further than a greedy step, and costs as many
// of them as there are sequences.
#pragma once

#include <array>
#include <cstdint>

#include "planner/search/unseen_heuristic.hpp"
#include "planner/search/world.hpp"
#include "planner/world/view_walk.hpp"

namespace ivo::planner {

class Lookahead {
 public:
  static constexpr int kMostMoves = 3;
  /// Rows of the seen map that a sequence of moves may change. What it shows beyond counts and stays unseen: its next
  /// moves may count it again. It takes discs of hundreds of rows to get there.
  static constexpr int kUndo = 8192;

  explicit Lookahead(const World& world) noexcept : world_(world), unseen_(world) {}

  /// Another mission.
  void open() noexcept;
  /// `patience`: a mass seen as late as an agent takes for so many of the graph's spacings counts 1/e of one seen now.
  /// Moves from 1 to kMostMoves.
  void start(int moves, double patience) noexcept;

  /// An agent looks from a node; times are from now on.
  void begin(int agent, Node here) noexcept;
  /// Up to about `rows` rows. `seen` is changed while it works and as before when it is done. Returns the work done.
  int advance(SeenMap& seen, int rows) noexcept;
  [[nodiscard]] bool done() const noexcept { return depth_ < 0; }
  /// When done: the first move, -1 when no edge of the node shows anything new that is worth the resolution of a mass.
  [[nodiscard]] Edge first_move() const noexcept { return levels_[0].chosen; }

 private:
  static constexpr int kWidth = 4;     // edges followed at each move
  static constexpr int kWeights = 64;  // of an eighth of the patience each

  struct Option {
    Eta rate{};
    Edge edge = -1;
  };
  struct Level {
    Edge next = 0;  // to weigh
    Edge end = 0;
    int count = 0;
    int option = 0;  // under way
    std::array<Option, kWidth> options{};
    Seconds from_s{};
    int undo_mark = 0;
    Mass value{};  // of the option under way
    Mass best{};
    Edge chosen = -1;
  };
  struct Undo {
    std::int32_t row = 0;
    std::int32_t byte = 0;
    std::uint64_t word = 0;
  };

  enum class Task : std::uint8_t { kWeigh, kFollow, kUndo };

  void push(Node here, Seconds from_s) noexcept;
  int weigh(const SeenMap& seen, int rows) noexcept;
  void take_option(Edge e, Mass mass) noexcept;
  void begin_option() noexcept;
  int follow(SeenMap& seen, int rows) noexcept;
  int undo(SeenMap& seen, int rows) noexcept;
  void end_option() noexcept;
  [[nodiscard]] Mass weighted(Mass mass, Seconds time_s) const noexcept;

  const World& world_;
  int agent_ = 0;
  int moves_ = 1;
  int depth_ = -1;  // of the level under way
  Task task_ = Task::kWeigh;
  UnseenMass unseen_;
  bool weighing_ = false;  // an edge is under way
  ViewWalk walk_;          // of the option that is followed
  Mass shown_{};           // by its swath under way
  std::array<Level, kMostMoves> levels_{};
  std::array<Undo, kUndo> undo_{};
  int undo_count_ = 0;
  std::array<Seconds, limits::kAgents> eighth_s_{};  // of the patience
  std::array<Mass, kWeights> weights_{};             // as shares of 1
};

}  // namespace ivo::planner
