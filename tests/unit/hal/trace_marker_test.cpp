#include "hal/linux/trace_marker.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <sstream>

#include "config/base/realtime.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ivo::hal {
namespace {

/// As the loop calls it: RealtimeSanitizer watches.
void cycle(TraceMarker& marker) noexcept IVO_REALTIME {
  marker.begin_cycle();
  marker.end_phase(0);
  marker.end_phase(1);
  marker.end_cycle();
}

TEST(TraceMarker, WritesACycleAndItsPhasesAsNestedSlices) {
  const ScratchFolder folder;
  const std::string path = folder.put("trace_marker", "");
  const std::array<std::string_view, 2> phases{"read", "write"};
  Result<TraceMarker> marker = TraceMarker::open(phases, path);
  ASSERT_TRUE(marker.ok());
  cycle(marker.value());
  std::ostringstream lines;
  lines << std::ifstream(path).rdbuf();
  const std::string pid = std::to_string(::getpid());
  const std::string end = "E|" + pid + "\n";
  EXPECT_EQ(lines.str(), "B|" + pid + "|cycle\nB|" + pid + "|read\n" + end + "B|" + pid + "|write\n" + end + end);
  EXPECT_EQ(marker.value().lost(), 0U);
}

TEST(TraceMarker, CountsTheLinesThatTheKernelDoesNotTake) {
  Result<TraceMarker> marker = TraceMarker::open({}, "/dev/full");
  ASSERT_TRUE(marker.ok());
  marker.value().begin_cycle();
  marker.value().end_cycle();
  EXPECT_EQ(marker.value().lost(), 2U);
}

TEST(TraceMarker, SaysWhatIsMissingWhereThereIsNoTrace) {
  const Result<TraceMarker> marker = TraceMarker::open({}, "/nowhere/trace_marker");
  ASSERT_FALSE(marker.ok());
  EXPECT_EQ(
      marker.error().message,
      "/nowhere/trace_marker: cannot be written: No such file or directory; expected tracefs to be mounted there, "
      "and root");
}

}  // namespace
}  // namespace ivo::hal
