# Gates for the solver of a project that has found assay.
#
#   assay_add_gate(NAME test ORACLE oracle LEVELS n... RESULT file COMMAND word... [PARAMS key=value...] [TYPICAL]
#                  [ERROR name=bound...] [ORDER name=bound...] [MUST_FAIL gate...] [JUDGE_OPTIONS word...]
#                  [LABELS label...] [TIMEOUT s])
#
# adds a test that runs COMMAND once per level and has `assay judge` compare the results with the oracle. @LEVEL@ in
# COMMAND and in RESULT stands for the level; COMMAND may be an executable target, and holds no empty word. It runs in a
# folder of its own, CMAKE_CURRENT_BINARY_DIR/NAME, where RESULT is looked for; report.html and report.json end up there too.
# PARAMS are the oracle's parameters, in SI units; TYPICAL takes its typical values for those not given.
# ERROR: an error of the finest level is at most the bound. ORDER: the order observed between the two finest levels is
# at least the bound. What names errors have, `assay judge --help` says. The test passes only if all gates do.
#
# MUST_FAIL turns a test around: COMMAND is broken on purpose, and the test passes only if the results can be judged and
# each of the gates named ("P", or "rate P" for an order) fails. It shows that the gate works.
#
#   assay_add_image_gate(NAME test IMAGE file REFERENCE file [COMMAND word...] [TOLERANCE share tile] [MUST_FAIL]
#                        [LABELS label...] [TIMEOUT s])
#
# adds a test that runs COMMAND, which makes IMAGE, and compares that with REFERENCE, both PNG. TOLERANCE: the shares of
# pixels that may differ visibly, in all and within the worst tile; `assay compare --help` says more. Relative names are
# in the folder of the test for IMAGE, and in CMAKE_CURRENT_SOURCE_DIR for REFERENCE. Without COMMAND, IMAGE is there
# already, from another test. MUST_FAIL: the pictures can be compared, and differ.

# Adds the test NAME: it runs the script `text`, of assignments, and then assayGateRun.cmake.
function(assay_add_script_test name text labels timeout)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${name})
  file(MAKE_DIRECTORY ${folder})
  # At generation, since words may hold generator expressions.
  file(GENERATE OUTPUT ${folder}/gate$<$<BOOL:$<CONFIG>>:-$<CONFIG>>.cmake CONTENT "${text}")
  add_test(NAME ${name} WORKING_DIRECTORY ${folder}
    COMMAND ${CMAKE_COMMAND} -P ${folder}/gate$<$<BOOL:$<CONFIG>>:-$<CONFIG>>.cmake)
  if(labels)
    set_tests_properties(${name} PROPERTIES LABELS "${labels}")
  endif()
  if(timeout)
    set_tests_properties(${name} PROPERTIES TIMEOUT ${timeout})
  endif()
endfunction()

# Adds to `text`, a script: the words of the list `words`, whatever they hold, become those of `variable`. An executable
# target stands for its file where it is the first word of a command.
function(assay_script_list variable words)
  string(APPEND text "set(${variable} \"\")\n")
  set(first TRUE)
  foreach(word IN LISTS ${words})
    if(first AND variable STREQUAL "command" AND TARGET "${word}")
      set(word $<TARGET_FILE:${word}>)
    endif()
    set(first FALSE)
    string(REPLACE ";" "\\;" word "${word}")
    string(APPEND text "list(APPEND ${variable} [====[${word}]====])\n")
  endforeach()
  set(text "${text}" PARENT_SCOPE)
endfunction()

macro(assay_check_arguments function)
  foreach(keyword ${ARGN})
    if(NOT DEFINED A_${keyword})
      message(FATAL_ERROR "${function}(${A_NAME}): needs ${keyword}")
    endif()
  endforeach()
  if(A_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${function}(${A_NAME}): knows no ${A_UNPARSED_ARGUMENTS}")
  endif()
  if(A_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "${function}(${A_NAME}): nothing follows ${A_KEYWORDS_MISSING_VALUES}")
  endif()
endmacro()

function(assay_add_gate)
  cmake_parse_arguments(PARSE_ARGV 0 A "TYPICAL" "NAME;ORACLE;RESULT;TIMEOUT"
    "COMMAND;LEVELS;PARAMS;ERROR;ORDER;MUST_FAIL;JUDGE_OPTIONS;LABELS")
  assay_check_arguments(assay_add_gate NAME ORACLE RESULT COMMAND LEVELS)
  list(LENGTH A_LEVELS levels)
  if(NOT A_ERROR AND NOT A_ORDER)
    message(FATAL_ERROR "assay_add_gate(${A_NAME}): needs ERROR or ORDER, or there is nothing that could fail")
  endif()
  if(A_ORDER AND levels LESS 2)
    message(FATAL_ERROR "assay_add_gate(${A_NAME}): an ORDER is observed between two levels, but LEVELS has one")
  endif()
  if(levels GREATER 1 AND NOT A_RESULT MATCHES "@LEVEL@")
    message(FATAL_ERROR "assay_add_gate(${A_NAME}): RESULT must hold @LEVEL@, or levels overwrite one another")
  endif()
  set(options --oracle ${A_ORACLE})
  foreach(value IN LISTS A_PARAMS)
    list(APPEND options --param ${value})
  endforeach()
  if(A_TYPICAL)
    list(APPEND options --typical)
  endif()
  foreach(bound IN LISTS A_ERROR)
    list(APPEND options --gate ${bound})
  endforeach()
  foreach(bound IN LISTS A_ORDER)
    list(APPEND options --gate "rate ${bound}")
  endforeach()
  list(APPEND options ${A_JUDGE_OPTIONS})
  set(program $<TARGET_FILE:assay::assay>)
  set(text "")
  assay_script_list(assay program)
  assay_script_list(command A_COMMAND)
  assay_script_list(levels A_LEVELS)
  assay_script_list(result A_RESULT)
  assay_script_list(options options)
  assay_script_list(must_fail A_MUST_FAIL)
  string(APPEND text "include([====[${CMAKE_CURRENT_FUNCTION_LIST_DIR}/assayGateRun.cmake]====])\nassay_judge()\n")
  assay_add_script_test(${A_NAME} "${text}" "${A_LABELS}" "${A_TIMEOUT}")
endfunction()

function(assay_add_image_gate)
  cmake_parse_arguments(PARSE_ARGV 0 A "MUST_FAIL" "NAME;IMAGE;REFERENCE;TIMEOUT" "COMMAND;TOLERANCE;LABELS")
  assay_check_arguments(assay_add_image_gate NAME IMAGE REFERENCE)
  set(options "")
  if(A_TOLERANCE)
    list(JOIN A_TOLERANCE "," tolerance)
    set(options --tolerance ${tolerance})
  endif()
  get_filename_component(reference "${A_REFERENCE}" ABSOLUTE)
  set(program $<TARGET_FILE:assay::assay>)
  set(text "")
  assay_script_list(assay program)
  assay_script_list(command A_COMMAND)
  assay_script_list(image A_IMAGE)
  assay_script_list(reference reference)
  assay_script_list(options options)
  assay_script_list(must_fail A_MUST_FAIL)
  string(APPEND text "include([====[${CMAKE_CURRENT_FUNCTION_LIST_DIR}/assayGateRun.cmake]====])\nassay_compare()\n")
  assay_add_script_test(${A_NAME} "${text}" "${A_LABELS}" "${A_TIMEOUT}")
endfunction()
