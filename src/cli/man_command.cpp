// The manual page is written in the macros of man(7).
#include <fmt/format.h>

#include <crt/version.hpp>
#include <string>

#include "cli/commands.hpp"
#include "cli/reporter.hpp"

namespace crt::cli {

namespace {

/// Returns a text so that it is shown as it is.
std::string as_roff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      // A line that begins with one of these would be a request.
      const bool begins_line = result.empty() || result.back() == '\n';
      if (begins_line && (c == '.' || c == '\'')) result += "\\&";
      result += c;
    }
  }
  return result;
}

/// Returns lines that are shown as they are broken.
std::string verbatim(const std::string& lines) {
  return lines.empty() ? "" : ".PP\n.nf\n" + as_roff(lines) + "\n.fi\n";
}

std::string option_paragraph(const OptionDescription& option) {
  std::string text = ".TP\n";
  if (option.names.empty()) {
    text += fmt::format("\\fI{}\\fR{}\n", as_roff(option.type), option.repeatable ? " ..." : "");
  } else {
    for (const std::string& name : option.names)
      text +=
          fmt::format("{}\\fB{}\\fR", &name == &option.names.front() ? "" : ", ", as_roff(name));
    if (!option.type.empty()) text += fmt::format(" \\fI{}\\fR", as_roff(option.type));
    text += "\n";
  }
  return text + as_roff(option.help) + "\n";
}

std::string command_section(const CommandDescription& command) {
  std::string text = fmt::format(".SS crt {}\n{}\n", command.name, as_roff(command.about));
  std::string group;
  for (const OptionDescription& option : command.options) {
    if (option.group != group) {
      group = option.group;
      text += fmt::format(".PP\n\\fB{}:\\fR\n", as_roff(group));
    }
    text += option_paragraph(option);
  }
  return text + verbatim(command.footer);
}

std::string manual_page(const CommandDescriptions& all) {
  std::string text = fmt::format(".TH CRT 1 \"\" \"CRT {}\" \"User Commands\"\n", version());
  text += ".SH NAME\ncrt \\- render scenes of analytic solids\n";
  text += ".SH SYNOPSIS\n";
  for (const CommandDescription& command : all.commands) {
    text += fmt::format(".B crt {}\n", command.name);
    for (const OptionDescription& option : command.options) {
      if (option.names.empty())
        text +=
            fmt::format("\\fI{}\\fR{}\n", as_roff(option.type), option.repeatable ? " ..." : "");
    }
    text += "[\\fIOPTION\\fR ...]\n.br\n";
  }
  text += ".SH DESCRIPTION\n" + as_roff(all.main.about) + "\n";
  text += ".SH OPTIONS\n";
  for (const OptionDescription& option : all.main.options) text += option_paragraph(option);
  text += ".SH COMMANDS\n";
  for (const CommandDescription& command : all.commands) text += command_section(command);
  return text + ".SH EXAMPLES AND EXIT STATUS\n" + verbatim(all.main.footer);
}

}  // namespace

ExitCode run_man(const ManRequest& request) {
  Reporter reporter(CommonRequest{});
  reporter.print(manual_page(request.commands), Reporter::IfClosed::fails);
  return reporter.finish();
}

}  // namespace crt::cli
