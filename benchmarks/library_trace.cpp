// Traces a deck by the library arcwall::model over and over, and prints the CPU time of each trace in seconds, a line
// each: what a trace in Python is compared with (benchmarks/python_figures.py).
//
//   library_trace DECK REPETITIONS
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "answers/sessions.hpp"
#include "model/deck/toml_source.hpp"

int main(int count, char** arguments) {
  if (count != 3) {
    std::fprintf(stderr, "usage: library_trace DECK REPETITIONS\n");
    return 2;
  }
  const std::string text = arcwall::deck::read_text_file(arguments[1]);
  for (int left = std::atoi(arguments[2]); left > 0; --left) {
    const std::clock_t begin = std::clock();
    arcwall::Session run =
        arcwall::make_session({.deck = arguments[1], .deck_text = text, .assignments = {"path.jumps=false"}});
    while (run.next() != nullptr) {
    }
    std::printf("%.6f\n", double(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return 0;
}
