# Which file goes where in which .deb; toolchain/package makes them. Included last by CMakeLists.txt.
#
# Destinations are those of the robot's file system, from its root: `cmake --install BUILD --prefix ROOT --component NAME`
# fills a folder in the same way.

set(here ${CMAKE_CURRENT_LIST_DIR})

# Version and date are the changelog's.
file(STRINGS ${here}/changelog first LIMIT_COUNT 1)
string(REGEX REPLACE "^ivo \\(([^)]+)\\).*" "\\1" IVO_PACKAGE_VERSION "${first}")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${here}/changelog)

set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # the programs are enough, not every test

# ivo-controller: what runs on the robot, under systemd.
set(controller COMPONENT controller)
install(TARGETS ivo DESTINATION usr/bin ${controller})
install(FILES ${here}/controller/ivo-controller.service DESTINATION usr/lib/systemd/system ${controller})
install(FILES ${here}/controller/60-ivo.preset DESTINATION usr/lib/systemd/system-preset ${controller})
install(FILES ${here}/controller/60-ivo-gpio.rules DESTINATION usr/lib/udev/rules.d ${controller})
install(FILES ${here}/controller/60-ivo-can.conf DESTINATION usr/lib/sysctl.d ${controller})
install(FILES ${here}/controller/60-ivo-can0.network ${here}/controller/60-ivo-can0.link DESTINATION etc/systemd/network
        ${controller})
install(FILES ${here}/controller/controller.env config/classes.toml DESTINATION etc/ivo ${controller})
install(FILES config/robots/ivo.toml DESTINATION etc/ivo RENAME robot.toml ${controller})
install(DIRECTORY config/eds config/schemas DESTINATION usr/share/ivo ${controller})
install(FILES ${here}/controller/README.Debian DESTINATION usr/share/doc/ivo-controller ${controller})
install(FILES ${here}/controller/watchdog.conf DESTINATION usr/share/doc/ivo-controller/examples ${controller})

# ivo-console: the page, for who has a screen.
set(console COMPONENT console)
install(TARGETS ivo-console DESTINATION usr/bin ${console})
install(DIRECTORY firmware/web/page/ DESTINATION usr/share/ivo-console/web ${console} PATTERN README.md EXCLUDE)
install(FILES ${here}/console/ivo-console.service DESTINATION usr/lib/systemd/system ${console})
install(FILES ${here}/console/60-ivo-console.preset DESTINATION usr/lib/systemd/system-preset ${console})
install(FILES ${here}/console/console.env DESTINATION etc/ivo ${console})
install(FILES ${here}/console/README.Debian firmware/web/protocol.md DESTINATION usr/share/doc/ivo-console ${console})

# ivo-tools: for the desk and for whoever puts drives on a base.
set(tools COMPONENT tools)
install(TARGETS ivo-drives DESTINATION usr/bin ${tools})
if(TARGET drive-contract) # made with the tests
  install(TARGETS drive-contract DESTINATION usr/bin ${tools})
  install(CODE "file(RENAME \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/usr/bin/drive-contract\"
                            \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/usr/bin/ivo-drive-contract\")" ${tools})
endif()
install(DIRECTORY config/missions config/maps config/robots DESTINATION usr/share/ivo ${tools})
install(FILES config/classes.toml DESTINATION usr/share/ivo ${tools})

# Each package says what it is allowed to be used for, and what has changed.
foreach(component controller console tools)
  install(FILES ${here}/copyright DESTINATION usr/share/doc/ivo-${component} COMPONENT ${component})
  install(CODE "execute_process(COMMAND gzip -9nc ${here}/changelog COMMAND_ERROR_IS_FATAL ANY
                  OUTPUT_FILE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/usr/share/doc/ivo-${component}/changelog.gz\")"
          COMPONENT ${component})
endforeach()

# A program for other processors than this one's: its instructions, by the names of /proc/cpuinfo. LZCNT is not asked for: who has BMI has
# it, and some virtual machines do not name it (abm).
set(IVO_CPU_FLAGS)
if(IVO_CPU STREQUAL "x86-64-v3")
  set(IVO_CPU_FLAGS "avx2 bmi1 bmi2 f16c fma movbe")
endif()
configure_file(${here}/preinst.in ${PROJECT_BINARY_DIR}/packaging/preinst @ONLY)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ivo)
set(CPACK_PACKAGE_VERSION ${IVO_PACKAGE_VERSION})
set(CPACK_PACKAGE_CONTACT "IVO maintainers <maintainers@ivo.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX "/")
set(CPACK_COMPONENTS_ALL controller console tools)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 1)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64)
elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE amd64)
endif()

set(CPACK_DEBIAN_CONTROLLER_PACKAGE_NAME ivo-controller)
set(CPACK_DEBIAN_CONTROLLER_PACKAGE_SECTION electronics)
set(CPACK_DEBIAN_CONTROLLER_PACKAGE_DEPENDS adduser)
set(CPACK_DEBIAN_CONTROLLER_PACKAGE_RECOMMENDS "systemd, iproute2, udev")
set(CPACK_DEBIAN_CONTROLLER_PACKAGE_SUGGESTS "ivo-tools, can-utils")
set(CPACK_DEBIAN_CONTROLLER_PACKAGE_CONTROL_EXTRA
    "${PROJECT_BINARY_DIR}/packaging/preinst;${here}/controller/postinst;${here}/controller/prerm;${here}/controller/postrm;${here}/controller/conffiles"
)
set(CPACK_COMPONENT_CONTROLLER_DESCRIPTION
    "search controller of a four-wheeled robot that looks for lost objects with people
Plans a search on a segmented map for a robot and a person, asks for consent, and drives four CiA 402 drives on a
CANopen bus at 500 Hz.
.
Comes with a systemd service that is not enabled and does not start before there is a mission in
/etc/ivo/mission.toml: nothing moves until the robot is configured.")

set(CPACK_DEBIAN_CONSOLE_PACKAGE_NAME ivo-console)
set(CPACK_DEBIAN_CONSOLE_PACKAGE_SECTION electronics)
# The socket is the controller's; Leaflet draws the map.
set(CPACK_DEBIAN_CONSOLE_PACKAGE_DEPENDS "ivo-controller, libjs-leaflet")
set(CPACK_DEBIAN_CONSOLE_PACKAGE_RECOMMENDS systemd)
set(CPACK_DEBIAN_CONSOLE_PACKAGE_CONTROL_EXTRA
    "${PROJECT_BINARY_DIR}/packaging/preinst;${here}/console/postinst;${here}/console/prerm;${here}/console/postrm;${here}/console/conffiles"
)
set(CPACK_COMPONENT_CONSOLE_DESCRIPTION
    "page and ROS port of the IVO search controller
A page on which people draw areas, agree with the robot on a plan, set it off and stop it, from any tablet or phone near
it, without internet; and a port for ROS tools that speak rosbridge v2.
.
Runs in a process of its own that may die without the controller noticing. Comes with a systemd service that is not
enabled.")

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME ivo-tools)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION electronics)
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS "ivo-controller, can-utils")
set(CPACK_DEBIAN_TOOLS_PACKAGE_CONTROL_EXTRA "${PROJECT_BINARY_DIR}/packaging/preinst")
set(CPACK_COMPONENT_TOOLS_DESCRIPTION
    "simulated drives, a contract test for drives, and examples for the IVO search controller
ivo-drives are four CiA 402 drives on a CAN interface, as an EDS describes them and as wrong as a script tells them to
be. ivo-drive-contract asks a drive, simulated or real, whether it does what the controller relies on. Missions,
maps and robots to begin with are in /usr/share/ivo.")

include(CPack)
