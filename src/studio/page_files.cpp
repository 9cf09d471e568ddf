#include "studio/page_files.hpp"

// The assembler puts the files' bytes here, which takes the compiler no time.
#define CRT_STUDIO_FILE(name, path) \
  asm(".pushsection .rodata\n"      \
      ".hidden " name               \
      "\n"                          \
      ".hidden " name               \
      "_end\n"                      \
      ".globl " name                \
      "\n"                          \
      ".globl " name "_end\n" name  \
      ":\n"                         \
      ".incbin \"" path "\"\n" name \
      "_end:\n"                     \
      ".popsection\n")

CRT_STUDIO_FILE("crt_studio_html", CRT_STUDIO_PAGE "/index.html");
CRT_STUDIO_FILE("crt_studio_script", CRT_STUDIO_PAGE "/studio.js");
CRT_STUDIO_FILE("crt_studio_style", CRT_STUDIO_PAGE "/studio.css");
CRT_STUDIO_FILE("crt_studio_licenses", CRT_STUDIO_PAGE "/licenses.txt");

extern "C" {
extern const char crt_studio_html[];
extern const char crt_studio_html_end[];
extern const char crt_studio_script[];
extern const char crt_studio_script_end[];
extern const char crt_studio_style[];
extern const char crt_studio_style_end[];
extern const char crt_studio_licenses[];
extern const char crt_studio_licenses_end[];
}

namespace crt::studio {

std::map<std::string, PageFile, std::less<>> page_files() {
  const auto content = [](const char* begin, const char* end) {
    return std::string_view(begin, static_cast<std::size_t>(end - begin));
  };
  return {
      {"/", {content(crt_studio_html, crt_studio_html_end), "text/html; charset=utf-8"}},
      {"/studio.js",
       {content(crt_studio_script, crt_studio_script_end), "text/javascript; charset=utf-8"}},
      {"/studio.css", {content(crt_studio_style, crt_studio_style_end), "text/css; charset=utf-8"}},
      {"/licenses.txt",
       {content(crt_studio_licenses, crt_studio_licenses_end), "text/plain; charset=utf-8"}}};
}

}  // namespace crt::studio
