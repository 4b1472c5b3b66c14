# SPDX-License-Identifier: BSD-3-Clause
cmake_minimum_required(VERSION 3.25)
execute_process(
  COMMAND git -C ${SOURCE_DIR} describe --always --dirty --abbrev=12 --exclude=*
  OUTPUT_VARIABLE commit
  ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT
"#pragma once
#define ICPSCAPE_RELEASE \"@RELEASE@\"
#define ICPSCAPE_COMMIT \"@commit@\"
" @ONLY)
