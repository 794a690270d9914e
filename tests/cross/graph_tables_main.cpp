// graph_tables FILE: builds the graphs of the cases and writes them as a C++ source of constant arrays, exact to the
// last bit, for CPUs without libccd.
#include <cinttypes>
#include <cstdio>

#include "tests/cross/search_cases.hpp"

namespace ivo::cross {
namespace {

planner::Graph graph;

bool build_graph(int number) {
  planner::SearchProblem problem;
  describe_case(number, problem);
  planner::GraphAgents agents;
  for (const planner::SearchAgent& agent : problem.agents) {
    (void)agents.push_back(agent.body);
  }
  if (const planner::Refusal refusal = graph.build(problem.map, problem.graph, agents)) {
    std::fprintf(stderr, "graph_tables: case %d: the graph is refused with code %d\n", number,
                 static_cast<int>(refusal.code));
    return false;
  }
  return true;
}

template <class Item>
void write_integers(std::FILE* file, const char* type, const char* name, int number, std::span<const Item> items) {
  std::fprintf(file, "constexpr %s %s%d[] = {", type, name, number);
  for (std::size_t i = 0; i < items.size(); ++i) {
    std::fprintf(file, "%s%" PRId32 ",", i % 24 == 0 ? "\n  " : "", static_cast<std::int32_t>(items[i]));
  }
  std::fputs("\n};\n", file);
}

void write_case(std::FILE* file, int number) {
  const planner::GraphTable table = graph.table();
  std::fprintf(file, "constexpr Point kPositions%d[] = {\n", number);
  for (const Point p : table.positions) {
    std::fprintf(file, "  {%a, %a},\n", p.x_m, p.y_m);
  }
  std::fputs("};\n", file);
  write_integers(file, "planner::Edge", "kFirstEdge", number, table.first_edge);
  write_integers(file, "planner::Node", "kHeads", number, table.heads);
  write_integers(file, "planner::AgentSet", "kOpenTo", number, table.open_to);
  std::fprintf(file,
               "constexpr planner::GraphTable kTable%d = {.spacing_m = %a, .agents = %d, .positions = kPositions%d,\n"
               "  .first_edge = kFirstEdge%d, .heads = kHeads%d, .open_to = kOpenTo%d};\n\n",
               number, table.spacing_m, table.agents, number, number, number, number);
}

bool write_tables(std::FILE* file) {
  std::fputs(
      "// Made by graph_tables_main.cpp.\n#include \"tests/cross/search_cases.hpp\"\n\nnamespace ivo::cross "
      "{\nnamespace {\n\n",
      file);
  for (int number = 0; number < kCases; ++number) {
    if (!build_graph(number)) {
      return false;
    }
    write_case(file, number);
  }
  std::fputs(
      "}  // namespace\n\nplanner::GraphTable graph_table(int number) noexcept {\n"
      "  constexpr const planner::GraphTable* kAll[] = {",
      file);
  for (int number = 0; number < kCases; ++number) {
    std::fprintf(file, "&kTable%d, ", number);
  }
  std::fputs("};\n  return *kAll[number];\n}\n\n}  // namespace ivo::cross\n", file);
  return true;
}

}  // namespace
}  // namespace ivo::cross

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: graph_tables FILE\n", stderr);
    return 2;
  }
  std::FILE* const file = std::fopen(arguments[1], "w");
  if (file == nullptr) {
    std::fprintf(stderr, "graph_tables: %s: cannot be written\n", arguments[1]);
    return 1;
  }
  const bool written = ivo::cross::write_tables(file);
  return std::fclose(file) == 0 && written ? 0 : 1;
}
