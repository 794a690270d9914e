// How long a rival may think: processor time of the thread that thinks, so that what else runs on the machine takes
// nothing from it; or a number of tries, so that a test repeats.
#pragma once

#include <ctime>
#include <limits>

namespace ivo::firmware::rivals {

struct Effort {
  double seconds = 1.0;
  int tries = std::numeric_limits<int>::max();  ///< plans begun
};

class Stopwatch {
 public:
  explicit Stopwatch(Effort effort) : effort_(effort), start_s_(now_s()) {}

  [[nodiscard]] double elapsed_s() const { return now_s() - start_s_; }
  [[nodiscard]] double seconds() const { return effort_.seconds; }
  /// Whether no further try may begin; the first always may.
  [[nodiscard]] bool over(int tries) const { return tries > 0 && (tries >= effort_.tries || out_of_time()); }
  /// Whether a try under way has to end.
  [[nodiscard]] bool out_of_time() const { return elapsed_s() >= effort_.seconds; }

 private:
  static double now_s() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }

  Effort effort_;
  double start_s_;
};

}  // namespace ivo::firmware::rivals
