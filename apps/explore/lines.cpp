#include "apps/explore/lines.hpp"

#include <new>
#include <string>

#include "apps/output/markup.hpp"

namespace arcwall::explore {

namespace {

Json problem_json(const std::string& problem) { return {{"errors", Json::array({{{"line", 0}, {"text", problem}}})}}; }

}  // namespace

void give_json(const Json& json, const LineSink& give) {
  constexpr bool ascii = true;
  give(json.dump(-1, ' ', ascii, Json::error_handler_t::replace) + "\n");
}

Json errors_json(const InputError& error) {
  Json list = Json::array();
  for (const Diagnostic& one : error.diagnostics())
    list.push_back({{"line", one.line}, {"text", plain(to_text(one), most_characters)}});
  return list;
}

void give_or_say_why_not(const LineSink& give, const std::function<void()>& body) {
  try {
    body();
  } catch (const InputError& error) {
    give_json({{"errors", errors_json(error)}}, give);
  } catch (const std::bad_alloc&) {
    give_json(problem_json("memory ran out; use fewer elements"), give);
  } catch (const std::exception& problem) {
    give_json(problem_json(std::string("internal error: ") + problem.what()), give);
  }
}

}  // namespace arcwall::explore
