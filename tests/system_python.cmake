# Debian's python3-vtk9 belongs to /usr/bin/python3, which need not be the first in PATH.
find_program(ASSAY_SYSTEM_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(NOT ASSAY_SYSTEM_PYTHON)
  find_program(ASSAY_SYSTEM_PYTHON NAMES python3 REQUIRED)
endif()
