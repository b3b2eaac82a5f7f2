# Optional (Debian: libsiconos-numerics-dev): contact dynamics by an independent library, for a test and a peer.
find_path(SICONOS_INCLUDE_DIR siconos/numerics/fc2d_Solvers.h)
find_library(SICONOS_NUMERICS_LIBRARY siconos_numerics)
mark_as_advanced(SICONOS_INCLUDE_DIR SICONOS_NUMERICS_LIBRARY)
if(SICONOS_INCLUDE_DIR AND SICONOS_NUMERICS_LIBRARY)
  # Its headers are C: only siconos_fc2d.c includes them.
  add_library(siconos_fc2d STATIC EXCLUDE_FROM_ALL tests/contact_dynamics/siconos_fc2d.c)
  target_include_directories(siconos_fc2d SYSTEM PRIVATE ${SICONOS_INCLUDE_DIR}/siconos ${SICONOS_INCLUDE_DIR}/siconos/numerics)
  target_link_libraries(siconos_fc2d PUBLIC ${SICONOS_NUMERICS_LIBRARY})
else()
  message(STATUS "Siconos not found: contact dynamics is not compared with it (libsiconos-numerics-dev)")
endif()
