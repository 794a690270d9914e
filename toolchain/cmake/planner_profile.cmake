# Which capacities the planner is built with (config/limits.hpp). One build, one profile: every room sees the same.
set(IVO_PLANNER_PROFILE onboard CACHE STRING "Capacities of the planner: micro, onboard or desktop")
set_property(CACHE IVO_PLANNER_PROFILE PROPERTY STRINGS micro onboard desktop)

if(IVO_PLANNER_PROFILE STREQUAL "micro")
  target_compile_definitions(ivo_flags INTERFACE IVO_PLANNER_PROFILE=Micro)
elseif(IVO_PLANNER_PROFILE STREQUAL "onboard")
  target_compile_definitions(ivo_flags INTERFACE IVO_PLANNER_PROFILE=Onboard)
elseif(IVO_PLANNER_PROFILE STREQUAL "desktop")
  target_compile_definitions(ivo_flags INTERFACE IVO_PLANNER_PROFILE=Desktop)
else()
  message(FATAL_ERROR "IVO_PLANNER_PROFILE is \"${IVO_PLANNER_PROFILE}\"; expected micro, onboard or desktop")
endif()

# With fixed-point arithmetic a search is the same, bit for bit, on every CPU.
option(IVO_PLANNER_FIXED "Search in fixed point" OFF)
if(IVO_PLANNER_FIXED)
  target_compile_definitions(ivo_flags INTERFACE IVO_PLANNER_FIXED=1)
endif()
