# Makes a C++ source of the parts of report.html, of the page of `explore` and of that of a sweep:
#
#   cmake -DFOLDER=… -DSCRIPTS=data,curve -DPLOTLY_SCRIPT=… -DMAP_SCRIPT=… -DPLOTLY_LICENCE=… -DOUTPUT=… -P embed_report.cmake
#
# Without plotly its three files are empty words.
foreach(part page_head.html page.html page.css print_head.html sheet.html picture.html sheet.css plots.js sweep.html sweep.js explore.html explore.css explore.js)
  file(READ "${FOLDER}/${part}" text)
  string(REPLACE "." "_" name ${part})
  set(${name} "${text}")
endforeach()
# The files of the script are one function with one scope, in this order: it shows the run whose parts are in the page.
string(REPLACE "," ";" names "${SCRIPTS}")
set(page_js "${plots_js}\nconst show_report = (data, before) => {\n")
foreach(name IN LISTS names)
  file(READ "${FOLDER}/script/${name}.js" text)
  string(APPEND page_js "${text}\n")
endforeach()
string(APPEND page_js "};\n")
set(sweep_js "${plots_js}\n${sweep_js}")
# The libraries as they stand inside a <script> element, which these would end or confuse.
foreach(name PLOTLY MAP)
  set(${name}_library "")
  if(PLOTLY_SCRIPT)
    file(READ "${${name}_SCRIPT}" script)
    file(READ "${PLOTLY_LICENCE}" licence)
    if(script MATCHES "</[sS][cC][rR][iI][pP][tT]|<!--")
      message(FATAL_ERROR "${${name}_SCRIPT} cannot stand in a page: it contains </script or <!--")
    endif()
    set(${name}_library "/*\nplotly.js\n\n${licence}*/\n${script}")
  endif()
endforeach()
file(WRITE "${OUTPUT}" "#include \"apps/output/report_parts.hpp\"

namespace arcwall {

const ReportParts& report_parts() {
  static const ReportParts parts{
      .page = R\"report(${page_head_html}${page_html})report\",
      .style = R\"report(${page_css})report\",
      .script = R\"report(${page_js})report\",
      .library = R\"report(${PLOTLY_library})report\",
      .sheet = R\"report(${print_head_html}${sheet_html})report\",
      .picture = R\"report(${print_head_html}${picture_html})report\",
      .sheet_style = R\"report(${sheet_css})report\",
      .sweep = R\"report(${page_head_html}${sweep_html})report\",
      .sweep_script = R\"report(${sweep_js})report\",
      .map_library = R\"report(${MAP_library})report\",
      .explorer_page = R\"report(${explore_html})report\",
      .explorer_style = R\"report(${explore_css})report\",
      .explorer_script = R\"report(${explore_js})report\",
  };
  return parts;
}

}  // namespace arcwall
")
