// `crt ask` says what rays from standard input meet, or in what points are.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <crt/query.hpp>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "cli/commands.hpp"
#include "cli/picture_renderer.hpp"
#include "cli/reporter.hpp"

namespace crt::cli {

namespace {

/// So many lines are answered at a time, side by side.
constexpr std::size_t batch_size = std::size_t{1} << 14;
/// No line of numbers is longer than that.
constexpr std::size_t longest_line = 4096;

constexpr std::string_view ray_columns = "ox,oy,oz,dx,dy,dz";
constexpr std::string_view point_columns = "x,y,z";
constexpr std::string_view hit_columns = "t,x,y,z,nx,ny,nz,u,v,entity,part,face,side";

[[noreturn]] void refuse_line(std::size_t line, const std::string& why) {
  throw Error(ErrorCode::io, fmt::format("<standard input>:{}: {}", line, why));
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// Reads lines of `count` numbers from standard input.
template <std::size_t count>
class NumberLines {
 public:
  explicit NumberLines(std::string_view columns) : columns_(columns) {}

  struct Line {
    std::array<double, count> numbers{};
    std::size_t number = 0;  ///< of the line, from 1 on
  };

  /// Reads up to `batch_size` lines, or fewer at the end.
  std::vector<Line> read() {
    std::vector<Line> lines;
    while (lines.size() < batch_size && next()) {
      const std::string_view text = trimmed(text_);
      if (text.empty()) continue;
      Line line{.numbers = {}, .number = number_};
      if (parse(text, line)) {
        lines.push_back(line);
      } else if (has_begun_ || is_wrong_number(text)) {
        refuse_line(number_, fmt::format("there must be {} numbers, {}", count, columns_));
      }
      has_begun_ = true;
    }
    return lines;
  }

 private:
  /// Reads the next line, and says whether there is one.
  bool next() {
    text_.clear();
    ++number_;
    for (int c = std::getc(stdin); c != EOF; c = std::getc(stdin)) {
      if (c == '\n') return true;
      text_ += static_cast<char>(c);
      if (text_.size() > longest_line)
        refuse_line(number_, fmt::format("the line has over {} bytes", longest_line));
    }
    if (std::ferror(stdin) != 0) {
      throw Error(ErrorCode::io, fmt::format("cannot read standard input: {}",
                                             std::generic_category().message(errno)));
    }
    return !text_.empty();
  }

  static bool parse(std::string_view text, Line& line) {
    std::size_t found = 0;
    while (true) {
      const std::size_t comma = text.find(',');
      const std::string_view word = trimmed(text.substr(0, comma));
      double number = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
      if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number))
        return false;
      if (found == count) return false;
      line.numbers.at(found++) = number;
      if (comma == std::string_view::npos) return found == count;
      text.remove_prefix(comma + 1);
    }
  }

  /// A first line that begins as a number is no line of names.
  static bool is_wrong_number(std::string_view text) {
    return std::string_view("+-.0123456789").find(text.front()) != std::string_view::npos;
  }

  std::string_view columns_;
  std::string text_;
  std::size_t number_ = 0;
  bool has_begun_ = false;
};

std::string hit_text(const FullHit& hit) {
  if (!hit.found()) return "inf,,,,,,,,,,,,";
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", hit.t, hit.position.x,
                     hit.position.y, hit.position.z, hit.normal.x, hit.normal.y, hit.normal.z,
                     hit.u, hit.v, hit.entity_id, hit.part_id, hit.face,
                     hit.side == HitSide::entering ? "enter" : "leave");
}

std::string location_text(const Location& location) {
  if (location.entity_id == no_entity_id) return "0,,\n";
  return fmt::format("1,{},{}\n", location.entity_id, location.part_id);
}

class Asking {
 public:
  Asking(const AskRequest& request, Reporter& reporter) : request_(request), reporter_(reporter) {}

  void run() {
    const ScriptResult result = run_scene(ScriptSource(request_.scene, request_.script.limits),
                                          request_.script, false, reporter_);
    if (!result.scene) return;
    const PreparedScene prepared = prepare(*result.scene);
    switch (request_.question.value_or(Question::intersect)) {
      case Question::intersect:
        return answer_rays(prepared, false);
      case Question::crossings:
        return answer_rays(prepared, true);
      case Question::contains:
        return answer_points(prepared);
    }
  }

 private:
  /// Calls answer(lines) for batch after batch.
  template <std::size_t count, class Answer>
  void for_batches(std::string_view columns, const Answer& answer) {
    NumberLines<count> lines(columns);
    for (auto batch = lines.read(); !batch.empty(); batch = lines.read()) {
      answer(batch);
    }
  }

  void print(const std::string& text) { reporter_.print(text, Reporter::IfClosed::fails); }

  void answer_rays(const PreparedScene& prepared, bool all_crossings) {
    print(fmt::format("{}{}\n", all_crossings ? "ray," : "", hit_columns));
    std::size_t before = 0;
    for_batches<6>(ray_columns, [&](const auto& lines) {
      std::vector<Ray> rays;
      rays.reserve(lines.size());
      for (const auto& line : lines) rays.push_back(ray_of(line));
      std::vector<std::vector<FullHit>> hits(rays.size());
      const auto ask = [&](RayQueries& queries, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          if (all_crossings) {
            queries.trace_all(rays[i], {}, hits[i]);
          } else {
            hits[i] = {queries.trace(rays[i])};
          }
        }
      };
      query_in_parallel(prepared, rays.size(), ask, request_.threads);
      std::string text;
      for (std::size_t i = 0; i < hits.size(); ++i) {
        for (const FullHit& hit : hits[i]) {
          if (all_crossings) text += fmt::format("{},", before + i);
          text += hit_text(hit) + "\n";
        }
      }
      before += rays.size();
      print(text);
    });
  }

  void answer_points(const PreparedScene& prepared) {
    print("inside,entity,part\n");
    for_batches<3>(point_columns, [&](const auto& lines) {
      std::vector<Vec3> points;
      points.reserve(lines.size());
      for (const auto& [numbers, number] : lines)
        points.emplace_back(numbers[0], numbers[1], numbers[2]);
      std::vector<Location> places(points.size());
      const auto ask = [&](RayQueries& queries, std::size_t first, std::size_t last) {
        queries.locate(std::span(points).subspan(first, last - first),
                       std::span(places).subspan(first, last - first));
      };
      query_in_parallel(prepared, points.size(), ask, request_.threads);
      std::string text;
      for (const Location& place : places) text += location_text(place);
      print(text);
    });
  }

  static Ray ray_of(const NumberLines<6>::Line& line) {
    const auto& [numbers, number] = line;
    const Ray ray{.origin = {numbers[0], numbers[1], numbers[2]},
                  .direction = {numbers[3], numbers[4], numbers[5]}};
    try {
      validate(ray);
    } catch (const Error& error) {
      refuse_line(number, error.what());
    }
    return ray;
  }

  const AskRequest& request_;
  Reporter& reporter_;
};

}  // namespace

ExitCode run_ask(const AskRequest& request) {
  Reporter reporter(request);
  if (request.scene == standard_stream) {
    reporter.add(ErrorCode::invalid_argument,
                 "standard input has the rays or points: the script must be a file",
                 ExitCode::usage);
    return reporter.finish();
  }
  try {
    Asking(request, reporter).run();
  } catch (const Error& error) {
    reporter.add(error);
  }
  return reporter.finish();
}

}  // namespace crt::cli
