include_guard() # included where needed, and once more with every file here
# Scenes for tests: the swinging cube with other gates, so that nothing else can come to differ.
set(scene_file ${CMAKE_SOURCE_DIR}/verify/scenes/swinging-cube.lua)
set(quick_gates ${CMAKE_CURRENT_SOURCE_DIR}/scenes/quick-gates.lua)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${scene_file} ${quick_gates})
file(READ ${scene_file} scene)
file(READ ${quick_gates} gates)
string(FIND "${scene}" "\ngates = not even and graded_gates or {\n" first)
string(SUBSTRING "${scene}" ${first} -1 rest)
string(FIND "${rest}" "\n}\n" last)
if(first EQUAL -1 OR last EQUAL -1)
  message(FATAL_ERROR "${scene_file}: no table of gates was found, from \"gates = ... {\" to \"}\"")
endif()
math(EXPR end "${last} + 3")
string(SUBSTRING "${scene}" 0 ${first} before)
string(SUBSTRING "${rest}" ${end} -1 after)
set(quick_scene ${CMAKE_BINARY_DIR}/scenes/swinging-cube-quick.lua)
file(CONFIGURE OUTPUT ${quick_scene} CONTENT "@before@\n@gates@@after@" @ONLY)
# Scenes with a bound for levels that take a second, in place of the one for their finest.
function(scene_with name old new out)
  set(file ${CMAKE_SOURCE_DIR}/verify/scenes/${name}.lua)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  string(FIND "${text}" "${old}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "${file}: \"${old}\" is not there to be replaced")
  endif()
  string(REPLACE "${old}" "${new}" text "${text}")
  set(${out} ${CMAKE_BINARY_DIR}/scenes/${name}.lua PARENT_SCOPE)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/scenes/${name}.lua CONTENT "@text@" @ONLY)
endfunction()
scene_with(bimaterial-wave "snapshots_sigma_l1 = 5e-4, [\"rate snapshots_sigma_l1\"] = 1.4, [\"figure ahead of the front\"] = 2e-4,
      [\"figure reflection\"] = 5e-6, [\"rate figure reflection\"] = 1.7, [\"figure transmission\"] = 1e-6"
  "P_l1 = 0.02, [\"rate P_l1\"] = 1" wave_scene)
scene_with(cantilever-plate "probes = 0.008, [\"rate probes\"] = 1.4, [\"figure period\"] = 6e-4"
  "probes = 0.02, [\"figure period\"] = 1.5e-3" plate_scene)
scene_with(breathing-sphere "[\"figure period\"] = 5e-3, [\"rate figure period\"] = 1.8, p = 0.065, [\"rate p\"] = 1.9, P = 0.051, [\"rate P\"] = 1.4,
      u = 0.049, [\"rate u\"] = 1.4, snapshots_p = 5.3e-3, [\"rate snapshots_p\"] = 1.2, snapshots_P = 0.0104,
      [\"rate snapshots_P\"] = 2, snapshots_u = 1.5e-3, [\"rate snapshots_u\"] = 1.7 },
    { when = { scheme = \"upwind\", cut = 1 },
      [\"figure period\"] = 5.1e-3, [\"rate figure period\"] = 1.8, p = 0.075, [\"rate p\"] = 1.9, P = 0.057, [\"rate P\"] = 1.4,
      u = 0.055, [\"rate u\"] = 1.4, snapshots_p = 5.8e-3, [\"rate snapshots_p\"] = 1.7, snapshots_P = 9.4e-3,
      [\"rate snapshots_P\"] = 2, snapshots_u = 2.3e-3, [\"rate snapshots_u\"] = 1.8"
  "[\"figure period\"] = 0.0183, [\"rate figure period\"] = 1.7, p = 0.287, [\"rate p\"] = 1.9, snapshots_P = 0.046, [\"rate snapshots_P\"] = 1.4 },
    { when = { scheme = \"upwind\", cut = 1 },
      [\"figure period\"] = 0.011, [\"rate figure period\"] = 1.7, p = 0.175, [\"rate p\"] = 1.9, snapshots_p = 0.0122,
      [\"rate snapshots_p\"] = 1.7, snapshots_P = 0.0227, [\"rate snapshots_P\"] = 1.6" sphere_scene)
scene_with(rotating-plate "beside = 0.04" "p_l1 = 1" plate_without_oracle)
