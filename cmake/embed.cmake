# Writes OUTPUT, a C++ source that contains the bytes of FILES with their paths below FOLDER, for apps/studio/page_files.h.
set(types_html "text/html; charset=utf-8")
set(types_js "text/javascript; charset=utf-8")
set(types_css "text/css; charset=utf-8")
set(types_svg "image/svg+xml")
set(types_jpg "image/jpeg")

set(arrays "")
set(entries "")
set(number 0)
foreach(file IN LISTS FILES)
  file(RELATIVE_PATH name ${FOLDER} ${file})
  string(REGEX MATCH "[a-z]+$" ending ${name})
  file(READ ${file} hex HEX)
  string(LENGTH "${hex}" size)
  math(EXPR size "${size} / 2")
  string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${hex}")
  string(REGEX REPLACE "(................................................................................................)" "\\1\"\n\"" bytes "${bytes}")
  string(APPEND arrays "constexpr char file_${number}[] =\n\"${bytes}\";\n")
  string(APPEND entries "    {\"${name}\", \"${types_${ending}}\", {file_${number}, ${size}}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUTPUT} "#include \"studio/page_files.h\"

namespace relievo::app::studio {
namespace {

${arrays}
constexpr PageFile files[] = {
${entries}};

}  // namespace

const PageFile* find_page_file(std::string_view name) {
  for (const PageFile& file : files)
    if (file.name == name) return &file;
  return nullptr;
}

}  // namespace relievo::app::studio
")
