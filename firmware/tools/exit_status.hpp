// What the programs return.
#pragma once

namespace ivo::firmware::exit_status {

inline constexpr int kEnded = 0;  ///< as planned
inline constexpr int kFaultOrStop = 1;
inline constexpr int kWrongInput = 2;  ///< nothing was moved or written
inline constexpr int kNoConsent = 3;   ///< plans were shown, nothing moved

}  // namespace ivo::firmware::exit_status
