# Makes a C++ source of the examples:
#
#   cmake -DFOLDER=… -DDECKS=arch,channel -DDEVICES=rail,ring -DSWEEPS=sweep-channel -DOUTPUT=… -P embed_decks.cmake
function(entries_of names result)
  string(REPLACE "," ";" names "${names}")
  set(entries "")
  foreach(name IN LISTS names)
    file(READ "${FOLDER}/${name}.toml" text)
    string(APPEND entries "      {\"${name}\", R\"deck(${text})deck\"},\n")
  endforeach()
  set(${result} "${entries}" PARENT_SCOPE)
endfunction()

entries_of("${DECKS}" decks)
entries_of("${DEVICES}" devices)
entries_of("${SWEEPS}" sweeps)
file(WRITE "${OUTPUT}" "#include \"apps/cli/example_decks.hpp\"

namespace arcwall {

const std::vector<ExampleDeck>& example_decks() {
  static const std::vector<ExampleDeck> decks{
${decks}  };
  return decks;
}

const std::vector<ExampleDeck>& example_devices() {
  static const std::vector<ExampleDeck> devices{
${devices}  };
  return devices;
}

const std::vector<ExampleDeck>& example_sweeps() {
  static const std::vector<ExampleDeck> sweeps{
${sweeps}  };
  return sweeps;
}

}  // namespace arcwall
")
