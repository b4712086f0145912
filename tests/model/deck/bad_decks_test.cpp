#include "tests/model/deck/bad_decks.hpp"

namespace arcwall::deck::bad_decks_test {

TEST(BadDecks, RootMaterialsAndPoints) {
  expect_refused({
      {"title = \"Everything\"", "", "title", "is missing"},
      {"title = \"Everything\"", "title = 3", "title", "3 is of the wrong type"},
      {"title = \"Everything\"", "titel = \"x\"", "titel", "did you mean title?"},
      {"[units]", "[unit]", "unit", "did you mean [units]?"},
      {"length = \"cm\"", "", "units.length", "is missing", -1},
      {"force = \"kN\"", "force = 1", "units.force", "wrong type"},
      {"E = 2.1e4", "", "material.steel.E", "is missing", -1},
      {"E = 2.1e4", "E = 0.0", "material.steel.E", "0 is out of range"},
      {"E = 2.1e4", "E = -1", "material.steel.E", "greater than 0"},
      {"E = 2.1e4", "E = \"stiff\"", "material.steel.E", "\"stiff\" has a name that is not in [variables]"},
      {"E = 2.1e4", "E = nan", "material.steel.E", "nan is not a finite number"},
      {"E = 2.1e4", "E = -inf", "material.steel.E", "-inf is not a finite number"},
      {"E = 2.1e4", "E = 1979-05-27", "material.steel.E", "a date or time is of the wrong type"},
      {"E = 2.1e4", "E = true", "material.steel.E", "wrong type"},
      {"E = 2.1e4", "E = [1]", "material.steel.E", "an array of 1"},
      {"nu = 0.29", "nu = 0.5", "material.steel.nu", "less than 0.5"},
      {"nu = 0.29", "nu = -1", "material.steel.nu", "out of range"},
      {"nu = 0.29", "rho = 1", "material.steel.rho", "not a key of this table; known are E, nu"},
      {"nu = 0.29", "", "member.arch.material", "has no nu, which theory essenburg needs", elsewhere},
      {"nu = 0.29", "", "member.wave.material", "has no nu, which theory reissner needs", elsewhere},
      {"[material.plain]", "[material.\"pl ain\"]", "\"pl ain\"", "is no name"},
      {"[material.plain]\nE = 7", "[material]\nplain = 7", "material.plain", "wrong type", 1},
      {"A = [0.0, 0.0]", "A = [0.0]", "point.A", "two numbers"},
      {"A = [0.0, 0.0]", "A = [0.0, 0.0, 0.0]", "point.A", "an array of 3 has the wrong length"},
      {"A = [0.0, 0.0]", "A = [0.0, \"0 +\"]", "point.A.1", "a bracket is missing"},
      {"A = [0.0, 0.0]", "A = [0,5, -1,25]", "point.A", "a decimal comma parts two numbers; write [0.5, -1.25]"},
      {"E = 2.1e4", "E = \"2,1e4\"", "material.steel.E", "write 2.1e4 without quotes"},
      {"A = [0.0, 0.0]", "A = [inf, 0.0]", "point.A.0", "not a finite number"},
      {"A = [0.0, 0.0]", "A = 0.0", "point.A", "wrong type"},
      {"A = [0.0, 0.0]", "\"a:b\" = [0.0, 0.0]", "\"a:b\"", "is no name"},
  });
}

TEST(BadDecks, Sections) {
  expect_refused({
      {"shape = \"rectangle\"", "", "section.square.shape", "is missing", -1},
      {"shape = \"rectangle\"", "shape = \"rectangel\"", "section.square.shape", "did you mean rectangle?"},
      {"shape = \"rectangle\"", "shape = \"I\"", "section.square.shape", "known are rectangle, circle, tube, general"},
      {"width = 0.1", "width = 0", "section.square.width", "greater than 0"},
      {"width = 0.1", "", "section.square.width", "is missing", elsewhere},
      {"height = 0.2", "height = -0.2", "section.square.height", "-0.2 is out of range"},
      {"shear_correction = 0.8", "shear_correction = 0", "section.square.shear_correction", "out of range"},
      {"shape = \"circle\"", "shape = \"rectangle\"", "section.rod.radius", "not a key of this table", 1},
      {"radius = 0.5\n[section.pipe]", "radius = -0.5\n[section.pipe]", "section.rod.radius", "out of range"},
      {"thickness = 0.05", "thickness = 0.6", "section.pipe.thickness", "0.6 is more than the outer radius 0.5"},
      {"thickness = 0.05", "thickness = 0.0", "section.pipe.thickness", "greater than 0"},
      {"A = 6.0", "A = 0", "section.bar.A", "out of range"},
      {"I = 2.0", "I = -2.0", "section.bar.I", "out of range"},
      {"shear_area = 5.0", "shear_area = 0.0", "section.slab.shear_area", "out of range"},
      {"height = 1.5", "height = 0.0", "section.slab.height", "out of range"},
  });
}

TEST(BadDecks, MembersAndTheirTheory) {
  expect_refused({
      {"from = \"A\"", "", "member.column.from", "is missing", -1},
      {"from = \"A\"", "from = \"Q\"", "member.column.from", "\"Q\" is not a point of this deck"},
      {"from = \"A\"", "from = \"B\"", "member.column.to", "also the point it comes from", 1},
      {"C = [4, 1]", "C = [2.0, 0.0]", "member.arch.to", "are both at [2, 0]", elsewhere},
      {"theory = \"euler-bernoulli\"", "theory = \"clasic\"", "member.column.theory", "did you mean euler-bernoulli?"},
      {"theory = \"euler-bernoulli\"", "theory = \"euler-bernoulli\"\norder = 2", "member.column.order",
       "theory euler-bernoulli has no order", 1},
      {"theory = \"euler-bernoulli\"", "theory = \"euler-bernoulli\"\nalong = \"fixed\"", "member.column.along",
       "theory essenburg", 1},
      {"theory = \"euler-bernoulli\"", "theory = \"euler-bernoulli\"\nstrain = \"log\"", "member.column.strain",
       "theory truss", 1},
      {"order = 1", "order = 3", "member.arch.order", "give 1 or 2"},
      {"order = 1", "order = 1.0", "member.arch.order", "1 is of the wrong type"},
      {"order = 4", "order = 5", "member.spline.order", "give 4 or 6"},
      {"section = \"rod\"", "section = \"bar\"", "member.arch.section", "has no shape over whose height"},
      {"along = \"director\"", "along = \"z\"", "member.arch.along", "known are fixed, director"},
      {"strain = \"log\"", "strain = \"hencky\"", "member.strut.strain", "known are green, engineering, log"},
      {"material = \"plain\"", "material = \"plane\"", "member.column.material", "did you mean plain?"},
      {"section = \"square\"", "section = \"sqare\"", "member.column.section", "did you mean square?"},
      {"elements = 80", "elements = 0", "member.column.elements", "at least 1"},
      {"elements = 80", "elements = 10000001", "member.column.elements", "at most 10000000"},
      {"elements = 80", "elements = 80.0", "member.column.elements", "80 is of the wrong type; give an integer"},
      {"elements = 80", "elements = 9223372036854775807", "member.column.elements", "out of range"},
      {"elements = 80", "elemnts = 80", "member.column.elemnts", "did you mean elements?"},
      {"hinge = [\"to\"]", "hinge = \"to\"", "member.column.hinge", "wrong type"},
      {"hinge = [\"to\"]", "hinge = [\"end\"]", "member.column.hinge", "no end of a member; known are from, to"},
      {"hinge = [\"to\"]", "hinge = [\"to\", \"to\"]", "member.column.hinge.1", "named twice"},
  });
}

TEST(BadDecks, AxesAndImperfections) {
  expect_refused({
      {"via = [3.0, 0.9]", "via = [3.0, 0.5]", "member.arch.via", "on the straight line"},
      {"via = [3.0, 0.9]", "via = [2.0, 0.0]", "member.arch.via", "is an end of the member"},
      {"via = [3.0, 0.9]", "via = [4, 1]", "member.arch.via", "is an end of the member"},
      {"via = [3.0, 0.9]", "via = [3.0, 0.9]\nsine = { rise = 1, waves = 1 }", "member.arch.sine", "has one axis", 1},
      {"rise = 0.1, ", "", "member.wave.sine.rise", "is missing"},
      {"waves = 2", "waves = 0", "member.wave.sine.waves", "at least 1"},
      {"sine = { rise = 0.1, waves = 2 }", "sine = 0.1", "member.wave.sine", "wrong type"},
      {"x = [0.0, 2.0, 4.0, 6.0]", "x = [0.0, 4.0, 6.0]", "member.spline.curve.z", "3 x and 4 z"},
      {"x = [0.0, 2.0, 4.0, 6.0]", "x = [0.5, 2.0, 4.0, 6.0]", "member.spline.curve.x", "begin at [0, 0]"},
      {"x = [0.0, 2.0, 4.0, 6.0]", "x = [0.0, 2.0, 4.0, 7.0]", "member.spline.curve.x", "end at [6, 1]"},
      {"x = [0.0, 2.0, 4.0, 6.0]", "x = [0.0, 2.0, 2.0, 6.0]", "member.spline.curve.x", "points 1 and 2 are the same"},
      {"x = [0.0, 2.0, 4.0, 6.0]", "x = [0.0, 5.8e300, 4.0, 6.0]", "member.spline.curve.x",
       "points 2 and 3 are the same to 9 digits"},
      {"x = [-1.0, 0.0, 1.0", "x = [-1e300, 0.0, 1.0", "wall.4.profile.x", "are the same to 9 digits"},
      {"x = [0.0, 2.0, 4.0, 6.0]", "x = []", "member.spline.curve.x", "the array is empty"},
      {"x = [0.0, 2.0, 4.0, 6.0]", "x = [0.0, 2.0, nan, 6.0]", "member.spline.curve.x.2", "not a finite number"},
      {"x = [0.0, 2.0, 4.0, 6.0], z = [0.0, 2.0, 2.0, 1.0]", "x = [0.0], z = [0.0]", "member.spline.curve.x",
       "at least 2"},
      {"amplitude = 1e-3, ", "", "member.column.imperfection.0.amplitude", "is missing"},
      {"waves = 3", "waves = 3.5", "member.column.imperfection.1.waves", "wrong type"},
      {"waves = 3", "waves = -3", "member.column.imperfection.1.waves", "out of range"},
      {"{ shape = \"sine\", amplitude = -1e-4", "{ shape = \"mode\", amplitude = -1e-4",
       "member.column.imperfection.1.shape", "known are sine"},
      {"imperfection = { shape = \"sine\",", "imperfection = {", "member.wave.imperfection.0.shape", "is missing"},
      {"imperfection = { shape", "imperfection = { phase = 1, shape", "member.wave.imperfection.0.phase", "not a key"},
  });
}

TEST(BadDecks, SupportsAndLoads) {
  expect_refused({
      {"A = [\"x\", \"z\", \"rotation\"]", "A = [\"x\", \"y\"]", "support.A", "\"y\" is no direction"},
      {"A = [\"x\", \"z\", \"rotation\"]", "A = [\"x\", \"x\"]", "support.A.1", "named twice"},
      {"A = [\"x\", \"z\", \"rotation\"]", "A = []", "support.A", "the array is empty"},
      {"A = [\"x\", \"z\", \"rotation\"]", "A = \"x\"", "support.A", "known are symmetry-x, symmetry-z"},
      {"A = [\"x\", \"z\", \"rotation\"]", "A = \"symmetry-y\"", "support.A", "did you mean symmetry-x?"},
      {"A = [\"x\", \"z\", \"rotation\"]", "A = 3", "support.A", "wrong type"},
      {"A = [\"x\", \"z\", \"rotation\"]", "A = [1]", "support.A.0", "1 is of the wrong type"},
      {"A = [\"x\", \"z\", \"rotation\"]", "Q = [\"x\"]", "support.Q", "not a point of this deck"},
      {"at = \"B\"", "", "load.0.at", "neither `at` nor `on`", -1},
      {"at = \"B\"", "at = \"B\"\non = \"arch\"", "load.0.on", "both `at` and `on`", 1},
      {"at = \"B\"", "at = \"Q\"", "load.0.at", "neither a point nor member:fraction"},
      {"at = \"B\"", "at = \"colum:0.5\"", "load.0.at", "did you mean column?"},
      {"at = \"B\"", "at = \"column:half\"", "load.0.at", "no fraction between 0 and 1"},
      {"at = \"B\"", "at = \"column:\"", "load.0.at", "no fraction"},
      {"at = \"B\"", "at = \"column:1.5\"", "load.0.at", "no fraction between 0 and 1"},
      {"at = \"B\"", "at = \"column:-0.5\"", "load.0.at", "no fraction"},
      {"at = \"B\"", "at = \"column:nan\"", "load.0.at", "no fraction"},
      {"at = \"B\"", "at = \"arch:0.25\"", "load.0.at", "the nearest are arch:0.2 and arch:0.3"},
      {"at = \"B\"", "at = 3", "load.0.at", "wrong type"},
      {"force = [-1.0, 0.5]\nmoment = 0.25", "", "load.0.force", "neither force nor moment", -2},
      {"force = [-1.0, 0.5]", "force = -1.0", "load.0.force", "wrong type"},
      {"force = [-1.0, 0.5]", "distributed = [-1.0, 0.5]", "load.0.distributed", "a load on a member"},
      {"moment = 0.25", "moment = [0.25]", "load.0.moment", "wrong type"},
      {"constant = true", "constant = 1", "load.1.constant", "give true or false"},
      {"on = \"arch\"", "on = \"arhc\"", "load.2.on", "did you mean arch?"},
      {"distributed = [0.0, -3.0]", "", "load.2.distributed", "is missing", -2},
      {"distributed = [0.0, -3.0]", "distributed = [0.0, -3.0]\nforce = [1, 1]", "load.2.force", "a load at a point",
       1},
      {"[[load]]\nat = \"B\"", "[load]\nat = \"B\"", "", "not valid TOML", elsewhere},
  });
}

TEST(BadDecks, Outlines) {
  const char* const ramp = "x = [10.5, 20.0, 30.0], z = [-30.0, -20.0, -31.0]";
  const char* const closed_ramp =
      "x = [10.5, 20.0, 30.0], z = [-30.0, -20.0, -31.0], closed = true, structure = \"outside\" }\ncorner_radius = "
      "0.125";
  expect_refused({
      {"name = \"stop\"", "name = \"stop\"\nside = \"above\"", "wall.5.side", "belongs to a profile", 1},
      {"name = \"stop\"", "name = \"stop\"\nprofile = { type = \"flat\", z = 9.0 }", "wall.5.profile",
       "does not go with an outline; keep one of them", 1},
      {"normal = [-1.0, 0.75]", "normal = [0.0, 0.0]", "wall.5.outline.normal", "has no direction"},
      {"point = [20.0, 0.0], normal", "normal", "wall.5.outline.point", "is missing"},
      {"type = \"half-plane\"", "type = \"halfplane\"", "wall.5.outline.type", "did you mean half-plane?"},
      {"outline = { type = \"half-plane\", point = [20.0, 0.0], normal = [-1.0, 0.75] }", "outline = 5.0",
       "wall.5.outline", "wrong type"},
      {"radius = 30.0", "radius = 0.0", "wall.6.outline.radius", "greater than 0"},
      {"radius = 30.0", "radius = -1.0", "wall.6.outline.radius", "greater than 0"},
      {"structure = \"inside\"", "structure = \"in\"", "wall.6.outline.structure", "known are outside, inside"},
      {"structure = \"inside\" }", "structure = \"inside\" }\ncorner_radius = 0.1", "wall.6.corner_radius",
       "belongs to an outline of type polyline", 1},
      {"axes = [2.5, 1.25]", "axes = [2.5, 0.0]", "wall.8.outline.axes", "greater than 0; give both"},
      {"axes = [2.5, 1.25]", "axes = 2.5", "wall.8.outline.axes", "wrong type"},
      {"z = [-40.0, -38.5, -41.0]", "z = [-40.0, -38.5]", "wall.9.outline.z", "3 x and 2 z"},
      {"x = [-40.5, 0.5, 40.0], z = [-40.0, -38.5, -41.0]", "x = [1.0], z = [2.0]", "wall.9.outline.x", "at least 2"},
      {"z = [-40.0, -38.5, -41.0]", "z = [-40.0, -38.5, -41.0], structure = \"inside\"", "wall.9.outline.structure",
       "belongs to a closed outline"},
      {"x = [-40.5, 0.5, 40.0], z = [-40.0, -38.5, -41.0]", "x = [1.0, 2.0], z = [2.0, 2.0], closed = true",
       "wall.9.outline.x", "2 points close nothing"},
      {ramp, "x = [10.5, 10.5, 30.0], z = [-30.0, -30.0, -31.0]", "wall.7.outline.x", "they are the same"},
      {ramp, "x = [10.5, 20.0, 30.0, 10.5], z = [-30.0, -20.0, -31.0, -30.0]", "wall.7.outline.x",
       "where the outline closes; leave the last point out"},
      {ramp, "x = [0.0, 1.0, 1.0, 0.0], z = [-30.0, -29.0, -30.0, -29.0]", "wall.7.outline.x", "crosses itself"},
      {closed_ramp,
       "x = [10.5, 20.0, 30.0, 20.0], z = [-30.0, -20.0, -31.0, -24.0], closed = true, structure = \"outside\" }\n"
       "corner_radius = 0.0",
       "wall.7.outline", "the corner at (20, -24) is re-entrant and sharp, and no other one is"},
      {"x = [10.5, 20.0, 30.0], z = [-30.0, -20.0, -31.0], closed = true, structure = \"outside\" }",
       "x = [10.5, 20.0, 11.0], z = [-30.0, -30.0, -30.0] }", "wall.7.outline", "turns back on itself"},
      {"corner_radius = 0.125", "corner_radius = 9.0", "wall.7.corner_radius", "too short; give a smaller"},
      {"corner_radius = 0.125", "corner_radius = -1.0", "wall.7.corner_radius", "at least 0"},
  });
}

TEST(BadDecks, WallsAndContact) {
  expect_refused({
      {"name = \"upper\"", "", "wall.0.name", "is missing", -1},
      {"name = \"upper\"", "name = \"the upper\"", "wall.0.name", "is no name"},
      {"name = \"slope\"", "name = \"upper\"", "wall.1.name", "name of another wall"},
      {"side = \"above\"", "", "wall.0.side", "is missing", elsewhere},
      {"side = \"above\"", "side = \"over\"", "wall.0.side", "known are above, below"},
      {"contact_surface = \"axis\"", "contact_surface = \"axes\"", "wall.0.contact_surface", "did you mean axis?"},
      {"contact_surface = \"axis\"", "", "wall.0.contact_surface", "section bar of member strut has no height",
       elsewhere},
      {"members = [\"column\", \"arch\"]", "members = [\"column\", \"arc\"]", "wall.1.members", "did you mean arch?"},
      {"members = [\"column\", \"arch\"]", "members = []", "wall.1.members", "the array is empty"},
      {"members = [\"column\", \"arch\"]", "members = [\"strut\"]", "wall.1.contact_surface", "has no height",
       elsewhere},
      {"profile = { type = \"flat\", z = 5.0 }", "", "wall.0.profile", "is missing", elsewhere},
      {"profile = { type = \"flat\", z = 5.0 }", "profile = 5.0", "wall.0.profile", "wrong type"},
      {"type = \"flat\", z = 5.0", "type = \"flat\"", "wall.0.profile.z", "is missing"},
      {"type = \"flat\", z = 5.0", "type = \"plane\", z = 5.0", "wall.0.profile.type", "did you mean line?"},
      {"type = \"flat\", z = 5.0", "type = \"flat\", z = 5.0, slope = 1", "wall.0.profile.slope", "not a key"},
      {"radius = 4.9", "radius = 0.0", "wall.2.profile.radius", "greater than 0"},
      {"centre = [1.0, -9.0]", "center = [1.0, -9.0]", "wall.2.profile.center", "did you mean centre?"},
      {"curvature = 0.1", "curvature = nan", "wall.3.profile.curvature", "finite"},
      {"x = [-1.0, 0.0,", "x = [-1.0, -1.0,", "wall.4.profile.x", "-1 follows -1; give x in increasing order"},
      {"x = [-1.0, 0.0,", "x = [0.0,", "wall.4.profile.z", "9 x and 10 z"},
      {"method = \"augmented\"", "method = \"lagrange\"", "contact.method", "known are multiplier, penalty, augmented"},
      {"penalty = 1e5", "", "contact.penalty", "method augmented needs it", elsewhere},
      {"penalty = 1e5", "penalty = 0", "contact.penalty", "greater than 0"},
      {"points = \"nodes\"", "points = \"node\"", "contact.points", "did you mean nodes?"},
      {"gap_tolerance = 1e-9", "gap_tolerance = 0.0", "contact.gap_tolerance", "greater than 0"},
  });
}

TEST(BadDecks, Path) {
  expect_refused({
      {"method = \"displacement\"", "method = \"sperical\"", "path.method", "did you mean spherical?"},
      {"method = \"displacement\"", "method = \"arclength\"", "path.method",
       "did you mean spherical or pseudo-arclength?"},
      {"method = \"displacement\"", "method = \"normal_plane\"", "path.method", "did you mean normal-plane?"},
      {"control = { at = \"column:0.5\", component = \"x\" }", "", "path.control", "method displacement needs it",
       elsewhere},
      {"component = \"x\" }", "component = \"reaction-x\" }", "path.control.component", "known are x, z, rotation"},
      {"control = { at = \"column:0.5\"", "control = { at = \"column:0.51\"", "path.control.at", "column:0.5125"},
      {"output_at = { mid = [-0.05],", "output_at = { middle = [-0.05],", "path.output_at.middle",
       "neither lambda nor a monitor"},
      {"output_at = { mid = [-0.05],", "output_at = { mid = -0.05,", "path.output_at.mid", "wrong type"},
      {"lambda = [0.4, 0.4475]", "lambda = []", "path.output_at.lambda", "the array is empty"},
      {"step = -0.5", "step = 0.0", "path.step", "other than 0"},
      {"min_step = 1e-6", "min_step = 0", "path.min_step", "greater than 0"},
      {"min_step = 1e-6", "min_step = 3", "path.max_step", "max_step = 2 is less than min_step = 3", 1},
      {"max_points = 100", "max_points = 0", "path.max_points", "at least 1"},
      {"branches = \"all\"", "branches = \"every\"", "path.branches", "known are primary, most-stable, all"},
      {"depth = 3", "depth = -1", "path.depth", "at least 0"},
      {"watch = [\"mid\", \"end\"]", "watch = [\"mid\", \"ned\"]", "path.watch", "\"ned\" is not a monitor"},
      {"watch = [\"mid\", \"end\"]", "watch = [\"mid\", \"mid\"]", "path.watch.1", "named twice"},
      {"events = \"detect\"", "events = \"find\"", "path.events", "known are locate, detect, none"},
      {"search = true", "search = 1", "path.search", "wrong type"},
      {"search = true", "", "path.search_at", "add search = true", 1},
      {"search_at = [0.3, 4.0]", "search_at = [0.3, 40.0]", "path.search_at", "40 is outside stop.lambda = [-1, 10]"},
      {"search_at = [0.3, 4.0]", "search_at = [nan]", "path.search_at.0", "nan is not a finite number"},
      {"search_at = [0.3, 4.0]", "search_at = 0.3", "path.search_at", "wrong type"},
      {"search_guesses = 7", "search_guesses = 0", "path.search_guesses", "at least 1"},
      {"search_guesses = 7", "search_guesses = 2.5", "path.search_guesses", "wrong type"},
      {"search_seed = 3", "search_seed = -1", "path.search_seed", "at least 0"},
      {"mid = [-0.16, 0.16]", "mid = [0.16, -0.16]", "path.stop.mid", "low less than high"},
      {"mid = [-0.16, 0.16]", "mid = [0.16, 0.16]", "path.stop.mid", "[0.16, 0.16] are no bounds"},
      {"mid = [-0.16, 0.16]", "mid = [0.16]", "path.stop.mid", "[0.16] are no bounds"},
      {"mid = [-0.16, 0.16]", "mid = 0.16", "path.stop.mid", "wrong type"},
      {"mid = [-0.16, 0.16]", "mdi = [-0.16, 0.16]", "path.stop.mdi", "did you mean mid?"},
      {"contacts = 40", "contacts = -1", "path.stop.contacts", "at least 0"},
      {"contacts = 40", "contacts = [1, 2]", "path.stop.contacts", "wrong type"},
      {"contacts = 40", "event = \"limit\"", "path.stop.event", "known are contact-closes"},
      {"contacts = 40", "event = [\"branch-pont\"]", "path.stop.event", "did you mean branch-point?"},
      {"contacts = 40", "event = 1", "path.stop.event", "wrong type"},
  });
}

TEST(BadDecks, EventsThatStopMustBeLookedFor) {
  const std::string text = replaced(full_deck, "contacts = 40", "event = \"limit-point\"");

  EXPECT_TRUE(diagnostics_of(text).empty());
  EXPECT_NE(all_of(diagnostics_of(replaced(text, "events = \"detect\"", "events = \"none\"")))
                .find("path.stop: event = \"limit-point\" never happens with events = \"none\""),
            std::string::npos);
}

TEST(BadDecks, Monitors) {
  expect_refused({
      {"name = \"end\"", "", "monitor.1.name", "is missing", -1},
      {"name = \"end\"", "name = \"mid\"", "monitor.1.name", "name of another monitor"},
      {"name = \"end\"", "name = \"\"", "monitor.1.name", "is no name"},
      {"name = \"end\"", "name = \"e n d\"", "monitor.1.name", "is no name"},
      {"component = \"reaction-z\"", "", "monitor.1.component", "is missing", elsewhere},
      {"component = \"reaction-z\"", "component = \"u\"", "monitor.1.component",
       "force-z, friction-force, friction-use, dissipation, slip, gap, contact-start, contact-end, max-moment, …"},
      {"component = \"reaction-z\"", "component = \"reaction-y\"", "monitor.1.component", "did you mean reaction-x?"},
      {"at = \"D\"", "at = \"strut:0.5\"", "monitor.1.at", "the nearest are strut:0 and strut:1"},
      {"at = \"D\"", "at = [6.0, 1.0]", "monitor.1.at", "wrong type"},
      {"sign = -1", "sign = 0", "monitor.1.sign", "give 1 or -1"},
      {"sign = -1", "sign = 2", "monitor.1.sign", "out of range"},
      {"sign = -1", "sing = -1", "monitor.1.sing", "did you mean sign?"},
      {"at = \"column:0.5\"\ncomponent = \"face-below-z\"", "at = \"strut:1\"\ncomponent = \"face-below-z\"",
       "monitor.0.component", "no height, so no face", 1},
      {"at = \"column:0.5\"\ncomponent = \"face-below-z\"", "at = \"C\"\ncomponent = \"face-below-z\"",
       "monitor.0.component", "section bar of member strut", 1},
  });
}

TEST(BadDecks, NamesOfOtherColumnsAreNoMonitors) {
  for (const char* name :
       {"branch", "step", "arc", "lambda", "unstable", "stability", "contacts", "energy", "iterations", "event"}) {
    const auto found = diagnostics_of(replaced(full_deck, "name = \"end\"", "name = \"" + std::string(name) + "\""));
    EXPECT_NE(all_of(found).find("name of another column"), std::string::npos) << name;
  }
}

TEST(BadDecks, IncrementalNeedsTheLoadsToLandOn) {
  const std::string searched = replaced(full_deck, "method = \"displacement\"", "method = \"incremental\"");
  const std::string text = replaced(searched, "search = true", "search = false");

  EXPECT_NE(all_of(diagnostics_of(searched)).find("path.search: method \"incremental\" leaves no equilibria"),
            std::string::npos);
  EXPECT_TRUE(diagnostics_of(text).empty());
  EXPECT_NE(
      all_of(diagnostics_of(replaced(text, ", lambda = [0.4, 0.4475]", ""))).find("path.output_at: lambda is missing"),
      std::string::npos);
  EXPECT_NE(all_of(diagnostics_of(replaced(text, "output_at = { mid = [-0.05], lambda = [0.4, 0.4475] }", "")))
                .find("path.output_at: lambda is missing"),
            std::string::npos);
}

TEST(BadDecks, ADeckNeedsPointsMembersAndALoadThatVaries) {
  const std::string nothing = all_of(diagnostics_of("description = \"soon\"\n"));
  const std::string constant =
      all_of(diagnostics_of(replaced(column_deck, "force = [-1.0, 0.0]", "force = [1.0, 0.0]\nconstant = true")));
  const std::string zero = all_of(diagnostics_of(replaced(column_deck, "force = [-1.0, 0.0]", "force = [0.0, 0.0]")));

  EXPECT_EQ(diagnostics_of("# nothing yet\n").size(), 1U);  // one cause, one error
  EXPECT_NE(nothing.find("title: is missing"), std::string::npos) << nothing;
  EXPECT_NE(nothing.find("point: is missing"), std::string::npos) << nothing;
  EXPECT_NE(nothing.find("there is no member"), std::string::npos) << nothing;
  EXPECT_NE(nothing.find("there is no load"), std::string::npos) << nothing;
  EXPECT_NE(constant.find("nothing varies with λ"), std::string::npos) << constant;
  EXPECT_NE(zero.find("nothing varies with λ"), std::string::npos) << zero;
  const std::string moved = std::string(column_deck.substr(0, column_deck.find("[[load]]")));
  EXPECT_TRUE(diagnostics_of(moved + "[[prescribed]]\nat = \"B\"\nx = -1.0\n").empty());
  EXPECT_FALSE(diagnostics_of(moved + "[[prescribed]]\nat = \"B\"\nx = 0.0\n").empty());
  EXPECT_FALSE(diagnostics_of(moved + "[[prescribed]]\nat = \"B\"\nx = 1.0\nconstant = true\n").empty());
}

TEST(BadDecks, APointMustEndAMemberToBeSupportedOrLoaded) {
  const std::string alone = replaced(column_deck, "[point]", "[point]\nalone = [9.0, 9.0]");

  EXPECT_TRUE(diagnostics_of(alone).empty());
  EXPECT_NE(
      all_of(diagnostics_of(replaced(alone, "B = [\"z\"]", "alone = [\"z\"]"))).find("support.alone: no member ends"),
      std::string::npos);
  EXPECT_NE(
      all_of(diagnostics_of(replaced(alone, "at = \"B\"", "at = \"alone\""))).find("no member ends at point alone"),
      std::string::npos);
}

// What others follow from is said before them.
TEST(BadDecks, APartUnderAnotherNameComesFirst) {
  const auto found = diagnostics_of(replaced(column_deck, "[member.column]", "[[members]]\nname = \"column\""));

  ASSERT_GT(found.size(), 1u);
  EXPECT_EQ(found[0].key, "members");
  EXPECT_EQ(found[0].cure, "did you mean [member.NAME]?");
  EXPECT_NE(all_of(diagnostics_of("title = \"x\"\nbeams = 3\n")).find("its parts are title, "), std::string::npos);
}

TEST(BadDecks, WordsOfOtherBooksAreUnderstood) {
  for (const auto& [theirs, ours] :
       {std::pair("displacement", "[[prescribed]]"), std::pair("imposed", "[[prescribed]]"),
        std::pair("sp", "[[prescribed]]"), std::pair("boundary", "[support]"), std::pair("foundation", "[[spring]]"),
        std::pair("bc", "[[prescribed]]"), std::pair("dirichlet", "[support]"), std::pair("motion", "its motion"),
        std::pair("link", "between"), std::pair("thermal", "temperature"), std::pair("expansion", "[material.NAME]"),
        std::pair("steps", "[[stage]]")}) {
    const auto found = diagnostics_of(std::string(column_deck) + "[[" + theirs + "]]\nat = \"B\"\n");
    ASSERT_EQ(found.size(), 1u) << theirs;
    EXPECT_NE(found[0].cure.find(ours), std::string::npos) << found[0].cure;
  }
  for (const auto& [theirs, ours] : {std::pair("euler", "euler-bernoulli"), std::pair("timoshenko", "reissner")}) {
    const auto found = diagnostics_of(
        replaced(column_deck, "theory = \"euler-bernoulli\"", "theory = \"" + std::string(theirs) + "\""));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].cure, "did you mean " + std::string(ours) + "?");
  }
}

// Messages stay readable, on one line each, whatever the deck has in it.
TEST(BadDecks, MessagesAreShortAndPrintable) {
  const std::string text =
      replaced(column_deck, "theory = \"euler-bernoulli\"", "theory = \"\\u0007\\n" + std::string(5000, 'x') + "\"");

  const auto found = diagnostics_of(text);

  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(to_text(found[0]).size(), 400u);
  EXPECT_EQ(to_text(found[0]).find_first_of("\n\a"), std::string::npos);
}

}  // namespace arcwall::deck::bad_decks_test
