// Bad scripts and bad overrides: the whole message, with file:line:column, the key, what was found and what is allowed.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scene/message_of.h"

namespace bookspin {
namespace {

struct BadScript {
  const char* name;
  const char* text;
  const char* message;
};

class Script : public testing::TestWithParam<BadScript> {};

TEST_P(Script, IsRefusedWithPlaceKeyFindingAndAllowance) {
  EXPECT_EQ(message_of(GetParam().text, {}), GetParam().message);
}

const BadScript bad_scripts[] = {
    {"unknown_key_in_the_scene", "title = \"T\"\ncapton = \"x\"\n[[book]]\n",
     "s.toml:2:1: capton: unknown key; did you mean caption?"},
    {"unknown_table", "title = \"T\"\n[camera]\nx = 1\n[[book]]\n",
     "s.toml:2:2: camera: unknown key; allowed: title, caption, seed, clip, view, book, expect, cue"},
    {"unknown_key_in_clip", "title = \"T\"\n[clip]\n  frame = 3\n[[book]]\n",
     "s.toml:3:3: clip.frame: unknown key; did you mean frames?"},
    {"unknown_key_in_view", "title = \"T\"\n[view]\nto = 3\n[[book]]\n",
     "s.toml:3:1: view.to: unknown key; allowed: from, head_up"},
    {"unknown_key_in_book", "title = \"T\"\n[[book]]\nmetod = \"matrix\"\n",
     "s.toml:3:1: book.0.metod: unknown key; did you mean method?"},
    {"unknown_key_in_expect", "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tilt\"\nat_most = 1\nat_mots = 2\n",
     "s.toml:6:1: expect.0.at_mots: unknown key; did you mean at_most?"},
    {"cue_without_words", "title = \"T\"\n[[book]]\n[[cue]]\nframes = [0, 9]\n",
     "s.toml:3:1: cue.0.says: is missing; allowed: a text in quotes, not empty"},
    {"cue_without_frames", "title = \"T\"\n[[book]]\n[[cue]]\nsays = \"S\"\n",
     "s.toml:3:1: cue.0.frames: is missing; allowed: two frames [first, last], from 0 to 100000, the first not after "
     "the last"},
    {"cues_that_overlap",
     "title = \"T\"\n[[book]]\n[[cue]]\nsays = \"S\"\nframes = [0, 9]\n[[cue]]\nsays = \"S\"\nframes = [9, 12]\n",
     "s.toml:8:10: cue.1.frames: found [9, 12]; allowed: frames after 9, the last of the cue before"},
    {"unknown_key_in_inline_table", "title = \"T\"\nclip = { frames = 10, fsp = 3 }\n[[book]]\n",
     "s.toml:2:23: clip.fsp: unknown key; did you mean fps?"},
    {"unknown_dotted_key", "title = \"T\"\nclip.fsp = 3\n[[book]]\n",
     "s.toml:2:6: clip.fsp: unknown key; did you mean fps?"},
    {"title_no_text", "title = 3\n[[book]]\n", "s.toml:1:9: title: found 3; allowed: a text in quotes"},
    {"title_missing", "\n[[book]]\n", "s.toml:1:1: title: is missing; allowed: a text in quotes"},
    {"title_empty", "title = \"\"\n[[book]]\n", "s.toml:1:9: title: found ''; allowed: a text in quotes, not empty"},
    {"caption_no_text", "title = \"T\"\ncaption = [1, 2]\n[[book]]\n",
     "s.toml:2:11: caption: found [1, 2]; allowed: a text in quotes"},
    {"seed_negative", "title = \"T\"\nseed = -1\n[[book]]\n",
     "s.toml:2:8: seed: found -1; allowed: a whole number from 0 to 2147483647"},
    {"seed_no_whole_number", "title = \"T\"\nseed = 1.5\n[[book]]\n",
     "s.toml:2:8: seed: found 1.5; allowed: a whole number from 0 to 2147483647"},
    {"seed_too_large", "title = \"T\"\nseed = 3000000000\n[[book]]\n",
     "s.toml:2:8: seed: found 3000000000; allowed: a whole number from 0 to 2147483647"},
    {"seed_a_text", "title = \"T\"\nseed = \"x\"\n[[book]]\n",
     "s.toml:2:8: seed: found 'x'; allowed: a whole number from 0 to 2147483647"},
    {"seed_a_long_text", "title = \"T\"\nseed = \"éééééééééééééééééééééééééééééééééééééééé\"\n[[book]]\n",
     "s.toml:2:8: seed: found 'ééééééééééééééééééééééééééééé ...; allowed: a whole number from 0 to 2147483647"},
    {"clip_a_value", "title = \"T\"\nclip = 3\n[[book]]\n", "s.toml:2:8: clip: found 3; allowed: a table [clip]"},
    {"clip_a_list", "title = \"T\"\n[[clip]]\nframes = 3\n[[book]]\n",
     "s.toml:2:1: clip: found a list of tables; allowed: a table [clip]"},
    {"view_a_value", "title = \"T\"\nview = \"x\"\n[[book]]\n", "s.toml:2:8: view: found 'x'; allowed: a table [view]"},
    {"book_a_table", "title = \"T\"\n[book]\nmethod = \"matrix\"\n",
     "s.toml:2:1: book: found a table; allowed: one or more tables [[book]]"},
    {"book_a_value", "title = \"T\"\nbook = 1\n", "s.toml:2:8: book: found 1; allowed: one or more tables [[book]]"},
    {"book_missing", "title = \"T\"\n", "s.toml:1:1: book: is missing; allowed: one or more tables [[book]]"},
    {"book_list_of_mixed_things", "title = \"T\"\nbook = [{}, 1]\n",
     "s.toml:2:13: book.1: found 1; allowed: a table [[book]]"},
    {"book_list_empty", "title = \"T\"\nbook = []\n",
     "s.toml:2:8: book: found []; allowed: one or more tables [[book]]"},
    {"expect_a_table", "title = \"T\"\n[[book]]\n[expect]\nquantity = \"tilt\"\n",
     "s.toml:3:1: expect: found a table; allowed: one or more tables [[expect]]"},
    {"nine_books",
     "title = \"T\"\n[[book]]\n[[book]]\n[[book]]\n[[book]]\n[[book]]\n[[book]]\n[[book]]\n[[book]]\n[[book]]\n",
     "s.toml:2:1: book: found 9 books of 900 frames; allowed: up to 8 books, and books x frames up to 300000"},
    {"too_much_memory", "title = \"T\"\n[clip]\nframes = 100000\n[[book]]\n[[book]]\n[[book]]\n[[book]]\n[[book]]\n",
     "s.toml:4:1: book: found 5 books of 100000 frames; allowed: up to 8 books, and books x frames up to 300000"},
    {"frames_zero", "title = \"T\"\n[clip]\nframes = 0\n[[book]]\n",
     "s.toml:3:10: clip.frames: found 0; allowed: a whole number from 1 to 100000"},
    {"frames_too_many", "title = \"T\"\n[clip]\nframes = 100001\n[[book]]\n",
     "s.toml:3:10: clip.frames: found 100001; allowed: a whole number from 1 to 100000"},
    {"frames_no_whole_number", "title = \"T\"\n[clip]\nframes = 10.0\n[[book]]\n",
     "s.toml:3:10: clip.frames: found 10.0; allowed: a whole number from 1 to 100000"},
    {"fps_zero", "title = \"T\"\n[clip]\nfps = 0\n[[book]]\n",
     "s.toml:3:7: clip.fps: found 0; allowed: a whole number from 1 to 240"},
    {"fps_too_high", "title = \"T\"\n[clip]\nfps = 241\n[[book]]\n",
     "s.toml:3:7: clip.fps: found 241; allowed: a whole number from 1 to 240"},
    {"time_zero", "title = \"T\"\n[clip]\ntime_per_frame = 0\n[[book]]\n",
     "s.toml:3:18: clip.time_per_frame: found 0; allowed: a number more than 0, up to 1e+06"},
    {"time_negative", "title = \"T\"\n[clip]\ntime_per_frame = -0.1\n[[book]]\n",
     "s.toml:3:18: clip.time_per_frame: found -0.1; allowed: a number more than 0, up to 1e+06"},
    {"time_infinite", "title = \"T\"\n[clip]\ntime_per_frame = inf\n[[book]]\n",
     "s.toml:3:18: clip.time_per_frame: found inf; allowed: a number more than 0, up to 1e+06"},
    {"time_no_number", "title = \"T\"\n[clip]\ntime_per_frame = nan\n[[book]]\n",
     "s.toml:3:18: clip.time_per_frame: found nan; allowed: a number more than 0, up to 1e+06"},
    {"time_a_text", "title = \"T\"\n[clip]\ntime_per_frame = \"fast\"\n[[book]]\n",
     "s.toml:3:18: clip.time_per_frame: found 'fast'; allowed: a number more than 0, up to 1e+06"},
    {"time_too_large", "title = \"T\"\n[clip]\ntime_per_frame = 1e7\n[[book]]\n",
     "s.toml:3:18: clip.time_per_frame: found 10000000.0; allowed: a number more than 0, up to 1e+06"},
    {"time_a_truth", "title = \"T\"\n[clip]\ntime_per_frame = true\n[[book]]\n",
     "s.toml:3:18: clip.time_per_frame: found true; allowed: a number more than 0, up to 1e+06"},
    {"substeps_zero", "title = \"T\"\n[clip]\nsubsteps = 0\n[[book]]\n",
     "s.toml:3:12: clip.substeps: found 0; allowed: a whole number from 1 to 1000000"},
    {"substeps_too_many", "title = \"T\"\n[clip]\nsubsteps = 1000001\n[[book]]\n",
     "s.toml:3:12: clip.substeps: found 1000001; allowed: a whole number from 1 to 1000000"},
    {"from_two_numbers", "title = \"T\"\n[view]\nfrom = [1, 2]\n[[book]]\n",
     "s.toml:3:8: view.from: found [1, 2]; allowed: a list of three numbers [x, y, z], each a number between -1e+06 "
     "and 1e+06"},
    {"from_straight_up", "title = \"T\"\n[view]\nfrom = [0, 3, 0]\n[[book]]\n",
     "s.toml:3:8: view.from: found [0, 3, 0]; allowed: a direction that does not point straight up or down: x or z not "
     "0"},
    {"from_nowhere", "title = \"T\"\n[view]\nfrom = [0, 0, 0]\n[[book]]\n",
     "s.toml:3:8: view.from: found [0, 0, 0]; allowed: a direction that does not point straight up or down: x or z not "
     "0"},
    {"from_with_a_text", "title = \"T\"\n[view]\nfrom = [1, \"a\", 2]\n[[book]]\n",
     "s.toml:3:8: view.from: found [1, 'a', 2]; allowed: a list of three numbers [x, y, z], each a number between "
     "-1e+06 and 1e+06"},
    {"from_with_nan", "title = \"T\"\n[view]\nfrom = [nan, 1, 2]\n[[book]]\n",
     "s.toml:3:8: view.from: found [nan, 1, 2]; allowed: a list of three numbers [x, y, z], each a number between "
     "-1e+06 and 1e+06"},
    {"from_a_number", "title = \"T\"\n[view]\nfrom = 3\n[[book]]\n",
     "s.toml:3:8: view.from: found 3; allowed: a list of three numbers [x, y, z], each a number between -1e+06 and "
     "1e+06"},
    {"name_no_text", "title = \"T\"\n[[book]]\nname = 3\n",
     "s.toml:3:8: book.0.name: found 3; allowed: a text in quotes"},
    {"method_unknown", "title = \"T\"\n[[book]]\nmethod = \"magic\"\n",
     "s.toml:3:10: book.0.method: found 'magic'; allowed: one of \"springs\", \"matrix\", \"quaternion\", \"exact\""},
    {"method_nearly", "title = \"T\"\n[[book]]\nmethod = \"exakt\"\n",
     "s.toml:3:10: book.0.method: found 'exakt'; allowed: one of \"springs\", \"matrix\", \"quaternion\", \"exact\"; "
     "did "
     "you mean \"exact\"?"},
    {"method_a_number", "title = \"T\"\n[[book]]\nmethod = 1\n",
     "s.toml:3:10: book.0.method: found 1; allowed: one of \"springs\", \"matrix\", \"quaternion\", \"exact\""},
    {"integrator_a_number", "title = \"T\"\n[[book]]\nmethod = \"matrix\"\nintegrator = 4\n",
     "s.toml:4:14: book.0.integrator: found 4; allowed: for matrix one of explicit_euler"},
    {"integrator_nearly", "title = \"T\"\n[[book]]\nmethod = \"quaternion\"\nintegrator = \"rk5\"\n",
     "s.toml:4:14: book.0.integrator: found 'rk5'; allowed: for quaternion one of explicit_euler, rk4, "
     "dmv; "
     "did you mean \"rk4\"?"},
    {"size_of_a_needle", "title = \"T\"\n[[book]]\nsize = [1, 0, 0]\n",
     "s.toml:3:8: book.0.size: found [1, 0, 0]; allowed: edges from 1e-06 to 1e+06, and 0 for one of them"},
    {"size_nearly_flat", "title = \"T\"\n[[book]]\nsize = [1, 1e-7, 1]\n",
     "s.toml:3:8: book.0.size: found [1, 1e-07, 1]; allowed: edges from 1e-06 to 1e+06, and 0 for one of them"},
    {"springs_of_a_flat_book", "title = \"T\"\n[[book]]\nsize = [1, 0, 1]\n",
     "s.toml:3:8: book.0.size: found [1, 0, 1]; allowed: three edges above 0: no spring keeps a flat book flat; "
     "matrix, quaternion and exact do"},
    {"springs_of_flat_moments", "title = \"T\"\n[[book]]\nmoments = [1, 2, 3]\n",
     "s.toml:3:11: book.0.moments: found [1, 2, 3]; allowed: three edges above 0: no spring keeps a flat book flat; "
     "matrix, quaternion and exact do"},
    {"moments_of_no_body", "title = \"T\"\n[[book]]\nmoments = [3, 5, 9]\n",
     "s.toml:3:11: book.0.moments: found [3, 5, 9]; allowed: those of a body: none is greater than the sum of the "
     "other two"},
    {"moment_too_small", "title = \"T\"\n[[book]]\nmoments = [1, 1, 1e-320]\n",
     "s.toml:3:11: book.0.moments: found [1, 1, 1e-320]; allowed: three that are from 1e-300 to 1e+308 when divided by "
     "particle_mass"},
    {"moment_of_no_mass", "title = \"T\"\n[[book]]\nmoments = [1, 2, 3]\nparticle_mass = 1e-320\n",
     "s.toml:3:11: book.0.moments: found [1, 2, 3]; allowed: three that are from 1e-300 to 1e+308 when divided by "
     "particle_mass"},
    {"moment_zero", "title = \"T\"\n[[book]]\nmoments = [1, 0, 1]\n",
     "s.toml:3:11: book.0.moments: found [1, 0, 1]; allowed: a list of three numbers [I1, I2, I3], each a number more "
     "than 0, up to 1e+12"},
    {"size_and_moments", "title = \"T\"\n[[book]]\nsize = [1, 2, 3]\nmoments = [2, 3, 4]\n",
     "s.toml:4:11: book.0.moments: found [2, 3, 4]; allowed: either size or moments"},
    {"two_spins", "title = \"T\"\n[[book]]\nangular_velocity = [1, 0, 0]\nangular_momentum = [1, 0, 0]\n",
     "s.toml:4:20: book.0.angular_momentum: found [1, 0, 0]; allowed: either angular_velocity or angular_momentum"},
    {"orientation_of_three", "title = \"T\"\n[[book]]\norientation = [1, 0, 0]\n",
     "s.toml:3:15: book.0.orientation: found [1, 0, 0]; allowed: a list of four numbers [w, x, y, z], each a number "
     "between -1e+06 and 1e+06"},
    {"orientation_of_length_0", "title = \"T\"\n[[book]]\norientation = [0, 0, 0, 0]\n",
     "s.toml:3:15: book.0.orientation: found [0, 0, 0, 0]; allowed: not all of them 0"},
    {"size_negative", "title = \"T\"\n[[book]]\nsize = [1, -2, 1]\n",
     "s.toml:3:8: book.0.size: found [1, -2, 1]; allowed: a list of three numbers [x, y, z], each a number from 0 "
     "to 1e+06"},
    {"size_of_four", "title = \"T\"\n[[book]]\nsize = [1, 2, 3, 4]\n",
     "s.toml:3:8: book.0.size: found [1, 2, 3, 4]; allowed: a list of three numbers [x, y, z], each a number from "
     "0 to 1e+06; decimals follow a point, not a comma"},
    {"omega_a_number", "title = \"T\"\n[[book]]\nangular_velocity = 3\n",
     "s.toml:3:20: book.0.angular_velocity: found 3; allowed: a list of three numbers [x, y, z], each a number between "
     "-1e+06 and 1e+06"},
    {"omega_too_large", "title = \"T\"\n[[book]]\nangular_velocity = [1e7, 0, 0]\n",
     "s.toml:3:20: book.0.angular_velocity: found [10000000.0, 0, 0]; allowed: a list of three numbers [x, y, z], each "
     "a number between -1e+06 and 1e+06"},
    {"jiggle_negative", "title = \"T\"\n[[book]]\njiggle = -0.1\n",
     "s.toml:3:10: book.0.jiggle: found -0.1; allowed: a number from 0 to 1"},
    {"jiggle_too_large", "title = \"T\"\n[[book]]\njiggle = 1.1\n",
     "s.toml:3:10: book.0.jiggle: found 1.1; allowed: a number from 0 to 1"},
    {"normalize_a_number", "title = \"T\"\n[[book]]\nnormalize = 1\n",
     "s.toml:3:13: book.0.normalize: found 1; allowed: true or false"},
    {"every_zeroth", "title = \"T\"\n[[book]]\nnormalize_every = 0\n",
     "s.toml:3:19: book.0.normalize_every: found 0; allowed: a whole number from 1 to 1000000"},
    {"every_no_whole_number", "title = \"T\"\n[[book]]\nnormalize_every = 1.0\n",
     "s.toml:3:19: book.0.normalize_every: found 1.0; allowed: a whole number from 1 to 1000000"},
    {"damping_negative", "title = \"T\"\n[[book]]\ndamping = -1\n",
     "s.toml:3:11: book.0.damping: found -1; allowed: true, false, or a number from 0 to 1000"},
    {"damping_a_text", "title = \"T\"\n[[book]]\ndamping = \"on\"\n",
     "s.toml:3:11: book.0.damping: found 'on'; allowed: true, false, or a number from 0 to 1000"},
    {"damping_too_large", "title = \"T\"\n[[book]]\ndamping = 1001\n",
     "s.toml:3:11: book.0.damping: found 1001; allowed: true, false, or a number from 0 to 1000"},
    {"damping_nan", "title = \"T\"\n[[book]]\ndamping = nan\n",
     "s.toml:3:11: book.0.damping: found nan; allowed: true, false, or a number from 0 to 1000"},
    {"stiffness_zero", "title = \"T\"\n[[book]]\nstiffness = 0\n",
     "s.toml:3:13: book.0.stiffness: found 0; allowed: a number more than 0, up to 1e+06"},
    {"mass_zero", "title = \"T\"\n[[book]]\nparticle_mass = 0\n",
     "s.toml:3:17: book.0.particle_mass: found 0; allowed: a number more than 0, up to 1e+06"},
    {"position_of_two", "title = \"T\"\n[[book]]\nposition = [1, 2]\n",
     "s.toml:3:12: book.0.position: found [1, 2]; allowed: a list of three numbers [x, y, z], each a number between "
     "-1e+06 and 1e+06"},
    {"style_unknown", "title = \"T\"\n[[book]]\nstyle = \"wire\"\n",
     "s.toml:3:9: book.0.style: found 'wire'; allowed: one of \"solid\", \"ghost\""},
    {"show_a_text", "title = \"T\"\n[[book]]\nshow = \"axes\"\n",
     "s.toml:3:8: book.0.show: found 'axes'; allowed: a list of \"axes\", \"angular_velocity\", "
     "\"angular_momentum\", \"trace\", \"springs\", \"exact\", \"unrotated\", \"polhode\""},
    {"show_what_is_not_there", "title = \"T\"\n[[book]]\nshow = [\"axes\", \"shadow\"]\n",
     "s.toml:3:17: book.0.show: found 'shadow'; allowed: a list of \"axes\", \"angular_velocity\", "
     "\"angular_momentum\", \"trace\", \"springs\", \"exact\", \"unrotated\", \"polhode\""},
    {"second_book", "title = \"T\"\n[[book]]\n[[book]]\n  size = 1\n",
     "s.toml:4:10: book.1.size: found 1; allowed: a list of three numbers [x, y, z], each a number from 0 to "
     "1e+06"},
    {"quantity_missing", "title = \"T\"\n[[book]]\n[[expect]]\nat_most = 1\n",
     "s.toml:3:1: expect.0.quantity: is missing; allowed: one of \"tilt\", \"flips\", \"stretch\", \"kinetic_energy\", "
     "\"elastic_energy\", \"energy_ratio\", \"angular_momentum_ratio\", \"norm\", "
     "\"largest_singular_value\", \"orthogonality_defect\", \"blend_defect\", "
     "\"pulsations\", \"angle_error\", \"exact_tilt\", \"exact_flips\", \"extent\", \"floor_hits\", \"exploded\", "
     "\"omega_Bx\", \"omega_By\", \"omega_Bz\", \"L_Bx\", \"L_By\", \"L_Bz\""},
    {"quantity_unknown", "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tlt\"\nat_most = 1\n",
     "s.toml:4:12: expect.0.quantity: found 'tlt'; allowed: one of \"tilt\", \"flips\", \"stretch\", "
     "\"kinetic_energy\", \"elastic_energy\", \"energy_ratio\", \"angular_momentum_ratio\", \"norm\", "
     "\"largest_singular_value\", \"orthogonality_defect\", \"blend_defect\", \"pulsations\", \"angle_error\", "
     "\"exact_tilt\", \"exact_flips\", \"extent\", "
     "\"floor_hits\", \"exploded\", \"omega_Bx\", \"omega_By\", \"omega_Bz\", \"L_Bx\", \"L_By\", \"L_Bz\"; did you "
     "mean \"tilt\"?"},
    {"expect_of_no_such_book", "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tilt\"\nbook = 1\nat_most = 2\n",
     "s.toml:5:8: expect.0.book: found 1; allowed: a whole number from 0 to 0"},
    {"expect_of_a_negative_book", "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tilt\"\nbook = -1\nat_most = 2\n",
     "s.toml:5:8: expect.0.book: found -1; allowed: a whole number from 0 to 0"},
    {"frame_and_frames",
     "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tilt\"\nframe = 1\nframes = [0, 1]\nat_most = 2\n",
     "s.toml:6:10: expect.0.frames: found [0, 1]; allowed: either frame or frames"},
    {"frame_negative", "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tilt\"\nframe = -1\nat_most = 2\n",
     "s.toml:5:9: expect.0.frame: found -1; allowed: a whole number from 0 to 100000"},
    {"range_of_three", "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tilt\"\nframes = [0, 1, 2]\nat_most = 2\n",
     "s.toml:5:10: expect.0.frames: found [0, 1, 2]; allowed: two frames [first, last], from 0 to 100000, the first "
     "not after the last"},
    {"range_reversed", "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tilt\"\nframes = [5, 1]\nat_most = 2\n",
     "s.toml:5:10: expect.0.frames: found [5, 1]; allowed: two frames [first, last], from 0 to 100000, the first not "
     "after the last"},
    {"range_no_whole_numbers",
     "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tilt\"\nframes = [0.0, 1]\nat_most = 2\n",
     "s.toml:5:10: expect.0.frames: found [0.0, 1]; allowed: two frames [first, last], from 0 to 100000, the first not "
     "after the last"},
    {"range_a_value", "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tilt\"\nframes = 3\nat_most = 2\n",
     "s.toml:5:10: expect.0.frames: found 3; allowed: two frames [first, last], from 0 to 100000, the first not after "
     "the last"},
    {"range_too_far", "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tilt\"\nframes = [0, 100001]\nat_most = 2\n",
     "s.toml:5:10: expect.0.frames: found [0, 100001]; allowed: two frames [first, last], from 0 to 100000, the first "
     "not after the last"},
    {"no_bound", "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tilt\"\n\n",
     "s.toml:3:1: expect.0.at_least: is missing; allowed: one of at_least, at_most (every frame), rises_to, falls_to "
     "(some frame)"},
    {"bound_a_text", "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tilt\"\nat_most = \"5\"\n",
     "s.toml:5:11: expect.0.at_most: found '5'; allowed: a number between -1e+300 and 1e+300"},
    {"bound_nan", "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tilt\"\nrises_to = nan\n",
     "s.toml:5:12: expect.0.rises_to: found nan; allowed: a number between -1e+300 and 1e+300"},
    {"says_no_text", "title = \"T\"\n[[book]]\n[[expect]]\nquantity = \"tilt\"\nsays = 3\nat_most = 1\n",
     "s.toml:5:8: expect.0.says: found 3; allowed: a text in quotes"},
    {"string_not_closed", "title = \"T\n",
     "s.toml:1:11: Error while parsing string: unescaped control characters other than TAB (U+0009) are explicitly "
     "prohibited"},
    {"bare_word", "title = T\n",
     "s.toml:1:9: Error while parsing boolean: expected 'true', saw 'T'; a text stands in quotes"},
    {"key_twice", "title = \"T\"\ntitle = \"U\"\n",
     "s.toml:2:9: Error while parsing key-value pair: cannot redefine existing string 'title'"},
    {"table_not_closed", "title = \"T\"\n[clip\n",
     "s.toml:2:6: Error while parsing table header: expected ']', saw '\\n'"},
    {"key_with_an_accent", "title = \"é\"\n[[book]]\nméthode = 1\n",
     "s.toml:3:2: Error while parsing key-value pair: expected '=', saw 'é'"},
};

INSTANTIATE_TEST_SUITE_P(Bad, Script, testing::ValuesIn(bad_scripts),
                         [](const testing::TestParamInfo<BadScript>& one) { return one.param.name; });

struct BadOverride {
  const char* text;
  const char* message;
};

class Override : public testing::TestWithParam<BadOverride> {};

TEST_P(Override, IsRefusedWithItsOwnWords) {
  const char* scene = "title = \"T\"\n[clip]\nframes = 10\n[[book]]\nmethod = \"matrix\"\n";
  EXPECT_EQ(message_of(scene, {GetParam().text}), GetParam().message);
}

const BadOverride bad_overrides[] = {
    {"clip.substeps=0", "--set clip.substeps=0: clip.substeps: found 0; allowed: a whole number from 1 to 1000000"},
    {"clip.substeps=x", "--set clip.substeps=x: clip.substeps: found 'x'; allowed: a whole number from 1 to 1000000"},
    {"clip.steps=3", "--set clip.steps=3: clip.steps: unknown key; allowed: frames, fps, time_per_frame, substeps"},
    {"clip.frames.x=3", "--set clip.frames.x=3: 'x' is below a value, not a table"},
    {"book.0.method=magic",
     "--set book.0.method=magic: book.0.method: found 'magic'; allowed: one of \"springs\", \"matrix\", "
     "\"quaternion\", \"exact\""},
    {"book.1.method=matrix", "--set book.1.method=matrix: there is no '1' in a list of 1, counted from 0"},
    {"book.x.method=matrix", "--set book.x.method=matrix: there is no 'x' in a list of 1, counted from 0"},
    {"book.-1.method=matrix", "--set book.-1.method=matrix: there is no '-1' in a list of 1, counted from 0"},
    {"book.method=matrix", "--set book.method=matrix: there is no 'method' in a list of 1, counted from 0"},
    {"book=3", "--set book=3: book: found 3; allowed: one or more tables [[book]]"},
    {"book.0=3", "--set book.0=3: book.0: found 3; allowed: a table [[book]]"},
    {"book.0.=3", "--set book.0.=3: a part of the key is empty"},
    {".clip.frames=3", "--set .clip.frames=3: a part of the key is empty"},
    {"clip..frames=3", "--set clip..frames=3: a part of the key is empty"},
    {"seed=1,5",
     "--set seed=1,5: seed: found '1,5'; allowed: a whole number from 0 to 2147483647; decimals follow a point, not a "
     "comma"},
    {"=3", "--set =3: allowed: KEY=VALUE, such as book.0.method=matrix"},
    {"clip", "--set clip: allowed: KEY=VALUE, such as book.0.method=matrix"},
    {"clip.substeps", "--set clip.substeps: allowed: KEY=VALUE, such as book.0.method=matrix"},
    {"", "--set : allowed: KEY=VALUE, such as book.0.method=matrix"},
    {"expect.0.at_most=3", "--set expect.0.at_most=3: the scene has no expect"},
    {"book.0.size=[1,2",
     "--set book.0.size=[1,2: book.0.size: found '[1,2'; allowed: a list of three numbers [x, y, z], each a number "
     "from 0 to 1e+06"},
    {"book.0.size=[1,2]",
     "--set book.0.size=[1,2]: book.0.size: found [1, 2]; allowed: a list of three numbers [x, y, z], each a number "
     "from 0 to 1e+06"},
    {"book.0.size.0=2", "--set book.0.size.0=2: the script has no list 'size': give it whole, such as size=[1, 2, 3]"},
    {"title=", "--set title=: title: found ''; allowed: a text in quotes, not empty"},
    {"title=7", "--set title=7: title: found 7; allowed: a text in quotes"},
    {"view.from=[0,1,0]",
     "--set view.from=[0,1,0]: view.from: found [0, 1, 0]; allowed: a direction that does not point straight up or "
     "down: x or z not 0"},
    {"vew.from=[1,1,1]", "--set vew.from=[1,1,1]: vew: unknown key; did you mean view?"},
    {"book.0.a'b=1", "--set book.0.a'b=1: Error while parsing key-value pair: expected '=', saw 'b'"},
    {"clip.substeps = 60", "--set clip.substeps = 60: clip.substeps : unknown key; did you mean substeps?"},
    {"clip={frmes=3}", "--set clip={frmes=3}: clip.frmes: unknown key; did you mean frames?"},
    {"book=[]", "--set book=[]: book: found []; allowed: one or more tables [[book]]"},
    {"seed=1\nseed=2", "--set seed=1\nseed=2: allowed: one value"},
    {"book.99999999999999999999.jiggle=0",
     "--set book.99999999999999999999.jiggle=0: there is no '99999999999999999999' in a list of 1, counted from 0"},
    {"book.0.damping=off",
     "--set book.0.damping=off: book.0.damping: found 'off'; allowed: true, false, or a number from 0 to 1000"},
    {"book.0.name=2012-01-01",
     "--set book.0.name=2012-01-01: book.0.name: found 2012-01-01; allowed: a text in quotes"},
};

INSTANTIATE_TEST_SUITE_P(Bad, Override, testing::ValuesIn(bad_overrides));

}  // namespace
}  // namespace bookspin
