# cmake -DSOURCE=... -DHEADER=... -P commit.cmake: the commit of the programs, at every build; cases, tests and documents beside them may differ from it.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git describe --always --tags WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE git OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
execute_process(COMMAND git diff --quiet HEAD -- CMakeLists.txt cmake libs applications WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE changed
    OUTPUT_QUIET ERROR_QUIET)
if(NOT git)
    set(git unknown)
elseif(changed)
    string(APPEND git -dirty)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define CORPUSCLE_GIT \"@git@\"\n" @ONLY)  # not written where it is the same
