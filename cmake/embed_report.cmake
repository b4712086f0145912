# Makes a C++ source of report.html's parts:
#
#   cmake -DFOLDER=… -DSCRIPTS=data,curve -DPLOTLY_SCRIPT=… -DPLOTLY_LICENCE=… -DOUTPUT=… -P embed_report.cmake
#
# Without plotly its two files are empty words.
foreach(part page.html page.css)
  file(READ "${FOLDER}/${part}" text)
  string(REPLACE "." "_" name ${part})
  set(${name} "${text}")
endforeach()
# The files of the script are one script with one scope, in this order.
string(REPLACE "," ";" names "${SCRIPTS}")
set(page_js "'use strict';\n(() => {\n")
foreach(name IN LISTS names)
  file(READ "${FOLDER}/script/${name}.js" text)
  string(APPEND page_js "${text}\n")
endforeach()
string(APPEND page_js "})();\n")
set(library "")
if(PLOTLY_SCRIPT)
  file(READ "${PLOTLY_SCRIPT}" script)
  file(READ "${PLOTLY_LICENCE}" licence)
  # It stands inside a <script> element, which these would end or confuse.
  if(script MATCHES "</[sS][cC][rR][iI][pP][tT]|<!--")
    message(FATAL_ERROR "${PLOTLY_SCRIPT} cannot stand in a page: it contains </script or <!--")
  endif()
  set(library "/*\nplotly.js\n\n${licence}*/\n${script}")
endif()
file(WRITE "${OUTPUT}" "#include \"apps/output/report_parts.hpp\"

namespace arcwall {

const ReportParts& report_parts() {
  static const ReportParts parts{
      .page = R\"report(${page_html})report\",
      .style = R\"report(${page_css})report\",
      .script = R\"report(${page_js})report\",
      .library = R\"report(${library})report\",
  };
  return parts;
}

}  // namespace arcwall
")
