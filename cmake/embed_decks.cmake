# Makes a C++ source of the example decks: cmake -DFOLDER=… -DNAMES=arch,channel -DOUTPUT=… -P embed_decks.cmake
string(REPLACE "," ";" names "${NAMES}")
set(entries "")
foreach(name IN LISTS names)
  file(READ "${FOLDER}/${name}.toml" text)
  string(APPEND entries "      {\"${name}\", R\"deck(${text})deck\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"apps/cli/example_decks.hpp\"

namespace arcwall {

const std::vector<ExampleDeck>& example_decks() {
  static const std::vector<ExampleDeck> decks{
${entries}  };
  return decks;
}

}  // namespace arcwall
")
