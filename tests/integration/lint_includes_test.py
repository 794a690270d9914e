#!/usr/bin/python3 -B
import unittest

import lint


class Includes(unittest.TestCase):
    def refuses(self, path, include, reason):
        status, said = lint.run("includes", {path: f"#pragma once\n\n#include {include}\n"})
        self.assertEqual(status, 1, f"{path} may not include {include}")
        self.assertIn(f"{path}:3: {include[1:-1]}: ", said)
        self.assertIn(reason, said)

    def accepts(self, path, include):
        self.assertEqual(lint.run("includes", {path: f"#include {include}\n"}), (0, ""))

    def test_no_source_includes_another(self):
        self.refuses("planner/world/graph.cpp", '"planner/world/graph_build.cpp"', "a source is compiled, not included")

    def test_config_stands_on_the_standard_library_alone(self):
        self.accepts("config/robot.hpp", "<array>")
        self.accepts("config/base/latest.hpp", '"config/base/contract.hpp"')
        self.refuses("config/robot.hpp", '"planner/search/plan.hpp"', "config may include only config")
        self.refuses("config/robot.hpp", "<Eigen/Core>", "config may include only the standard library in <>")

    def test_the_planner_sees_config_eigen_and_ccd_and_no_machine(self):
        self.accepts("planner/world/collision.cpp", "<ccd/ccd.h>")
        self.accepts("planner/world/collision.cpp", "<Eigen/Core>")
        self.refuses("planner/world/graph.cpp", '"hal/api/clock.hpp"', "planner may include only config, planner")
        self.refuses("planner/world/graph.cpp", "<unistd.h>", "planner may include only the standard library")

    def test_drivers_see_the_bus_and_not_the_kernel(self):
        self.accepts("drivers/canopen/sdo.hpp", '"hal/api/can_bus.hpp"')
        self.refuses("drivers/canopen/sdo.hpp", '"hal/linux/socketcan_bus.hpp"', "drivers may include only config, hal/api, drivers")
        self.refuses("drivers/canopen/sdo.hpp", "<linux/can.h>", "drivers may include only the standard library")

    def test_the_api_of_the_hal_knows_none_of_its_implementations(self):
        self.refuses("hal/api/clock.hpp", '"hal/sim/manual_clock.hpp"', "hal/api may include only config, hal/api")
        self.refuses("hal/sim/virtual_bus.hpp", '"hal/linux/socketcan_bus.hpp"', "hal/sim may include only")
        self.accepts("hal/linux/socketcan_bus.cpp", "<linux/can/raw.h>")

    def test_motion_safety_and_record_keep_to_themselves(self):
        self.accepts("firmware/motion/odometry.cpp", '"firmware/motion/kinematics.hpp"')
        self.accepts("firmware/safety/guarded_bus.hpp", '"hal/api/can_bus.hpp"')
        self.accepts("firmware/safety/wheel_monitor.hpp", '"drivers/drive_fault.hpp"')
        self.accepts("firmware/safety/wheel_monitor.hpp", '"firmware/motion/kinematics.hpp"')
        self.refuses("firmware/motion/kinematics.cpp", '"firmware/safety/mode.hpp"', "firmware/motion may include only")
        self.refuses("firmware/motion/odometry.cpp", '"hal/api/can_bus.hpp"', "firmware/motion may include only")
        self.refuses("firmware/safety/supervisor.cpp", '"drivers/cia402/drive.hpp"', "firmware/safety may include only")
        self.refuses("firmware/record/event_ring.hpp", '"firmware/loop/control_loop.hpp"', "firmware/record may include only")

    def test_only_the_composition_root_names_the_linux_side_of_the_hal(self):
        self.accepts("firmware/tools/run.cpp", '"hal/linux/socketcan_bus.hpp"')
        self.accepts("firmware/app.cpp", '"hal/linux/socketcan_bus.hpp"')
        self.refuses("firmware/loop/control_loop.cpp", '"hal/linux/monotonic_clock.hpp"', "firmware may include only")

    def test_tests_may_include_anything(self):
        self.accepts("tests/unit/planner/graph_test.cpp", '"hal/linux/socketcan_bus.hpp"')

    def test_the_product_may_not_include_its_tests(self):
        self.refuses("firmware/loop/control_loop.cpp", '"tests/support/deaf_drive.hpp"', "firmware may include only")

    def test_a_path_in_quotes_begins_at_the_root(self):
        self.refuses("drivers/cia402/drive.cpp", '"drive.hpp"', "begins at the root of the checkout")

    def test_an_include_in_a_comment_is_none(self):
        self.assertEqual(lint.run("includes", {"config/a.hpp": '// #include "planner/a.hpp"\n/*\n#include <Eigen/Core>\n*/\n'}), (0, ""))


unittest.main()
