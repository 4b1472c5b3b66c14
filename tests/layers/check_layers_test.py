#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of check_layers.py on small trees."""
import pathlib
import tempfile
import unittest

import check_layers

FOLDERS = {"common": "core", "cloud": "core", "io": "io", "simulation": "simulation"}


class CheckLayers(unittest.TestCase):
    def errors(self, files, folders=FOLDERS):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            # Two files that are as they should be, so that some file includes another.
            files = {"src/common/a.h": "#include <vector>",
                     "src/cloud/b.h": '#include "icpscape/common/a.h"\n#include <ceres/ceres.h>',
                     **files}
            for name, text in files.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            return check_layers.check(root, folders)

    def assert_one(self, files, message):
        errors = self.errors(files)
        self.assertEqual(len(errors), 1, errors)
        self.assertIn(message, errors[0])

    def test_what_is_allowed(self):
        self.assertEqual(self.errors({}), [])
        self.assertEqual(self.errors({"src/io/point_files.cc": '#include "icpscape/cloud/b.h"\n'
                                                               "#include <openssl/evp.h>",
                                      "residuals/adapters/ceres.h": "#include <ceres/ceres.h>",
                                      "apps/flags/f.cc": "#include <gflags/gflags.h>"}), [])

    def test_upwards(self):
        self.assert_one({"src/common/c.h": '\n#include "icpscape/cloud/b.h"'},
                        "src/common/c.h:2: includes src/cloud/b.h, of the layer src/cloud, which")

    def test_another_target(self):
        self.assert_one({"src/io/d.h": "", "src/simulation/e.h": '#include "icpscape/io/d.h"'},
                        "src/simulation/e.h:1: includes src/io/d.h of io, which simulation does")

    def test_a_library_of_another_target(self):
        self.assert_one({"src/cloud/c.cc": "#include <openssl/evp.h>"},
                        "src/cloud/c.cc:1: includes openssl/evp.h, which core does not use")
        self.assert_one({"residuals/m.h": "#include <ceres/ceres.h>"}, "which residuals does not")
        self.assert_one({"src/io/d.cc": "#include <gflags/gflags.h>"}, "which io does not use")
        self.assert_one({"src/io/d.cc": "#include <pcl/io/pcd_io.h>"}, "which io does not use")

    def test_flags(self):
        self.assert_one({"src/cloud/c.cc": 'throw E("expected --voxel_m above 0.");\nint i = --n;'},
                        "src/cloud/c.cc:1: names the flag --voxel_m;")
        self.assert_one({"src/cloud/c.h": "int voxel;  // From --voxel_m."}, "the flag --voxel_m;")
        self.assertEqual(self.errors({"src/cloud/c.cc": '"|---|"; --n;  // A -- b.',
                                      "apps/flags/f.cc": 'F("expected --voxel_m.");'}), [])

    def test_a_folder_without_a_target(self):
        errors = self.errors({}, {"common": "core"})
        self.assertEqual(errors, ["src/cloud: is in no target; expected it in src/CMakeLists.txt"])

    def test_a_file_that_is_not_there(self):
        self.assert_one({"src/cloud/c.h": '#include "icpscape/cloud/gone.h"'}, "is not in the tree")
        # By another name than the installed one.
        self.assert_one({"src/cloud/c.h": '#include "src/common/a.h"'}, "expected icpscape/FOLDER")


if __name__ == "__main__":
    unittest.main()
