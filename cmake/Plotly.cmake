# plotly.js for the curves of report.html, and that with maps for sweeps, fetched by npm in the version and with the hash of apps/report/package-lock.json:
# sets PLOTLY_SCRIPT, MAP_SCRIPT and PLOTLY_LICENCE to its files, or leaves them empty where it cannot be had.
include(NpmInstall)
set(ARCWALL_PLOTLY AUTO CACHE STRING
  "Curves of report.html by plotly.js, fetched by npm: ON, OFF (still pictures), AUTO (ON where npm can fetch it)")
set_property(CACHE ARCWALL_PLOTLY PROPERTY STRINGS AUTO ON OFF)
if(NOT ARCWALL_PLOTLY MATCHES "^(AUTO|ON|OFF)$")
  message(FATAL_ERROR "ARCWALL_PLOTLY is \"${ARCWALL_PLOTLY}\"; it must be AUTO, ON or OFF")
endif()

set(PLOTLY_SCRIPT "")
set(MAP_SCRIPT "")
set(PLOTLY_LICENCE "")
if(NOT ARCWALL_PLOTLY STREQUAL OFF)
  set(plotly_folder ${PROJECT_BINARY_DIR}/plotly)
  npm_install(SOURCE ${PROJECT_SOURCE_DIR}/apps/report FOLDER ${plotly_folder} PROBLEM plotly_problem)
  if(plotly_problem STREQUAL "")
    set(PLOTLY_SCRIPT ${plotly_folder}/node_modules/plotly.js-basic-dist-min/plotly-basic.min.js)
    set(MAP_SCRIPT ${plotly_folder}/node_modules/plotly.js-cartesian-dist-min/plotly-cartesian.min.js)
    set(PLOTLY_LICENCE ${plotly_folder}/node_modules/plotly.js-basic-dist-min/LICENSE)
  elseif(ARCWALL_PLOTLY STREQUAL ON)
    message(FATAL_ERROR "ARCWALL_PLOTLY is ON, but ${plotly_problem}")
  else()
    message(WARNING "report.html will show still pictures instead of plotly's curves: ${plotly_problem}\n"
      "With npm and a network configure again; -DARCWALL_PLOTLY=OFF silences this.")
  endif()
endif()
