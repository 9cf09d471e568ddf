# Writes a C++ source to OUT with a function of crt::service called FUNCTION, which returns the
# text of the file IN.
file(READ "${IN}" text)
set(fence "crt_text")
# A string that is too long for some compilers is put together from parts.
string(REPLACE "\n## " ")${fence}\"\nR\"${fence}(\n## " text "${text}")
file(WRITE "${OUT}" "#include <string_view>\n\nnamespace crt::service {\n
std::string_view ${FUNCTION}();\n
std::string_view ${FUNCTION}() {
  return R\"${fence}(${text})${fence}\";\n}\n\n}  // namespace crt::service\n")
