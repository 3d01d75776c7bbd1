// SPDX-License-Identifier: GPL-3.0-or-later
// The program `whitney` from outside: exit statuses, messages, files.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#ifdef WHITNEY_PROGRAM  // the program is built

namespace {

namespace fs = std::filesystem;

class Program : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("whitney_program_test_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string problem(const std::string& text) const {
    std::ofstream(path("problem.json")) << text;
    return path("problem.json");
  }
  static std::string content(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream all;
    all << in.rdbuf();
    return all.str();
  }
  /// Runs `whitney ARGUMENTS`; the exit status. Output of both kinds goes to output_.
  int run(const std::string& arguments) {
    const int status =
        std::system((std::string(WHITNEY_PROGRAM) + " " + arguments + " >" + path("output") + " 2>&1").c_str());
    output_ = content(path("output"));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  bool says(const std::string& text) const { return output_.find(text) != std::string::npos; }
  /// Files in the folder whose names begin with `name`: the file itself and any temporary of it.
  int files(const std::string& name) const {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(folder_))
      count += entry.path().filename().string().find(name) != std::string::npos;
    return count;
  }

  fs::path folder_;
  std::string output_;
};

constexpr const char* kTorus = R"({"variables": ["a","b","c","d"], "equations": ["a^2+b^2-1", "c^2+d^2-1"],
  "box": [[-2,2],[-2,2],[-2,2],[-2,2]], "triangulation": {"edge_length": 0.4}})";

TEST_F(Program, TracesWritesAndChecks) {
  ASSERT_EQ(
      run("trace " + problem(kTorus) + " -o " + path("t.ply") + " -o " + path("t.noff") + " --stats " + path("s.json")),
      0)
      << output_;
  EXPECT_TRUE(says("closed orientable surface, 1 component, Euler characteristic 0, genus 1")) << output_;
  const std::string stats = content(path("s.json"));
  for (const char* key :
       {"\"ambient_dim\": 4", "\"intrinsic_dim\": 2", "\"edge_length\": 0.4", "\"num_seeds_used\": 1",
        "\"simplices_per_dim\"", "\"euler_characteristic\": 0", "\"is_closed_manifold\": true", "\"Z^2\"",
        "\"oracle_evaluations\"", "\"distinct_vertices\"", "\"peak_rss_bytes\"", "\"stop_reason\": \"none\""})
    EXPECT_NE(stats.find(key), std::string::npos) << key;
  for (const char* file : {"t.ply", "t.noff"}) {
    EXPECT_EQ(run("check " + path(file)), 0);
    EXPECT_TRUE(says("genus 1")) << output_;
  }
}

TEST_F(Program, SameInputSameBytes) {
  ASSERT_EQ(run("trace " + problem(kTorus) + " -q -o " + path("a.noff")), 0);
  ASSERT_EQ(run("trace " + problem(kTorus) + " -q -o " + path("b.noff")), 0);
  EXPECT_TRUE(output_.empty()) << output_;
  EXPECT_EQ(content(path("a.noff")), content(path("b.noff")));
}

TEST_F(Program, EveryKindOfMesh) {
  for (const char* kind : {"pulled", "barycentric", "cells"}) {
    ASSERT_EQ(run("trace " + problem(kTorus) + " --mesh " + kind + " -o " + path("m.noff")), 0) << output_;
    EXPECT_EQ(run("check " + path("m.noff")), 0);
    EXPECT_TRUE(says("genus 1")) << kind << output_;
  }
}

TEST_F(Program, LimitsLeaveWhatWasFoundAndStatusTwo) {
  EXPECT_EQ(
      run("trace " + problem(kTorus) + " --max-simplices 500 -o " + path("part.off") + " --stats " + path("s.json")),
      2);
  EXPECT_TRUE(fs::exists(path("part.off")));
  EXPECT_NE(content(path("s.json")).find("\"stop_reason\": \"max_simplices\""), std::string::npos);
  EXPECT_EQ(run("trace " + problem(kTorus) + " --time-limit 0 -o " + path("none.off")), 2) << output_;
}

TEST_F(Program, BadInputIsStatusOneAndNamesThePlace) {
  const std::string out = " -o " + path("x.obj");
  EXPECT_EQ(run("trace " + path("absent.json") + out), 1);
  EXPECT_TRUE(says("absent.json")) << output_;
  EXPECT_EQ(run("trace " + problem("{\"variables\": [\"x\",\"y\"], \"equations\": [\"x^2+y^2-1\"], \"bax\": 1}") + out),
            1);
  EXPECT_TRUE(says("bax") && says("problem.json")) << output_;
  EXPECT_EQ(
      run("trace " + problem("{\"variables\": [\"x\",\"y\"], \"equations\": [\"x^2+y^2-1\"], \"seed_points\": [[1]]}") +
          out),
      1);
  EXPECT_TRUE(says("seed_points")) << output_;
  // No real points; a double zero; NaN on the manifold.
  EXPECT_EQ(
      run("trace " +
          problem("{\"variables\": [\"x\",\"y\"], \"equations\": [\"x^2+y^2+1\"], \"box\": [[-2,2],[-2,2]]}") + out),
      1);
  EXPECT_TRUE(says("no point of the manifold was found")) << output_;
  EXPECT_EQ(
      run("trace " +
          problem("{\"variables\": [\"x\",\"y\"], \"equations\": [\"(x^2+y^2-1)^2\"], \"box\": [[-2,2],[-2,2]]}") +
          out),
      1);
  EXPECT_TRUE(says("regular value")) << output_;
  EXPECT_EQ(
      run("trace " +
          problem("{\"variables\": [\"x\",\"y\"], \"equations\": [\"sqrt(x)+y^2-1\"], \"box\": [[-2,2],[-2,2]]}") +
          out),
      1);
  EXPECT_TRUE(says("NaN at (")) << output_;
  EXPECT_EQ(run("trace " + problem(kTorus) + " -o " + path("x.gif")), 1);
  EXPECT_TRUE(says(".gif")) << output_;
  EXPECT_EQ(run("trace " + problem(kTorus) + " -o " + path("no/folder/x.off")), 1);
  EXPECT_EQ(run("trace " + problem(kTorus) + " --mesh sponge"), 1);
  EXPECT_EQ(run("trace " + problem(kTorus) + " --edge-length -1"), 1);
  EXPECT_EQ(run("dance"), 1);
  EXPECT_EQ(files("x.obj"), 0);
  EXPECT_EQ(files("x.gif") + files("x.off"), 0);
}

TEST_F(Program, AFullDiskLosesOnlyTheFileThatDidNotFit) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  fs::create_symlink("/dev/full", path("full.off"));
  EXPECT_EQ(run("trace " + problem(kTorus) + " -o " + path("full.off") + " -o " + path("fine.off")), 1);
  EXPECT_TRUE(says("full.off")) << output_;
  EXPECT_EQ(run("check " + path("fine.off")), 0);
}

TEST_F(Program, TheBoxCutsAndItSaysSo) {
  EXPECT_EQ(run("trace " + problem(R"({"variables": ["x","y","z"], "equations": ["x^2+y^2-1"],
    "box": [[-2,2],[-2,2],[-2,2]], "triangulation": {"edge_length": 0.3}})")),
            0);
  EXPECT_TRUE(says("reaches the box") && says("2 boundary components")) << output_;
}

constexpr const char* kOctant = R"({"variables": ["x","y","z"], "equations": ["x^2+y^2+z^2-1"],
  "inequalities": ["x", "y", "z"], "box": [[-2,2],[-2,2],[-2,2]], "triangulation": {"edge_length": 0.3}})";

TEST_F(Program, StrataOfTheOctant) {
  ASSERT_EQ(run("trace " + problem(kOctant) + " -o " + path("o.vtu") + " -o " + path("o.ply") + " -o " + path("o.obj") +
                " --strata " + path("piece.noff") + " --stats " + path("s.json")),
            0)
      << output_;
  EXPECT_TRUE(says("1 of dimension 2, 3 of dimension 1, 3 of dimension 0")) << output_;
  const std::string stats = content(path("s.json"));
  for (const char* key : {"\"boundary_components\": 1", "\"cut_components\": 0", "\"strata\"", "\"x = 0\"",
                          "\"smallest_singular_value\"", "\"singular_points\": []"})
    EXPECT_NE(stats.find(key), std::string::npos) << key;
  // The whole with its labels reads back as the whole; each stratum is a disc, an arc or a point.
  for (const char* file : {"o.vtu", "o.ply", "o.obj"}) {
    EXPECT_EQ(run("check " + path(file)), 0) << output_;
    EXPECT_TRUE(says("orientable surface with 1 boundary component, 1 component, Euler characteristic 1")) << output_;
  }
  for (int s = 0; s < 7; ++s) {
    EXPECT_EQ(run("check " + path("piece_" + std::to_string(s) + ".noff")), 0) << output_;
    EXPECT_TRUE(says("Euler characteristic 1")) << output_;
  }
  EXPECT_FALSE(fs::exists(path("piece_7.noff")));
  EXPECT_NE(content(path("o.obj")).find("g stratum_6"), std::string::npos);
  EXPECT_NE(content(path("o.vtu")).find("Name=\"stratum\""), std::string::npos);
  EXPECT_NE(content(path("o.ply")).find("element edge"), std::string::npos);
}

TEST_F(Program, ASingularCutIsStatusThreeAndNamesThePlace) {
  const std::string torus = R"({"variables": ["a","b","c","d"], "equations": ["a^2+b^2-1", "c^2+d^2-1"],
    "inequalities": ["4 - (a-1)^2 - b^2 - (c-1)^2 - d^2"], "box": [[-2,2],[-2,2],[-2,2],[-2,2]],
    "triangulation": {"edge_length": 0.3}})";
  EXPECT_EQ(run("trace " + problem(torus) + " -o " + path("t.ply") + " --stats " + path("s.json")), 3);
  EXPECT_TRUE(says("SINGULAR at (")) << output_;
  EXPECT_TRUE(fs::exists(path("t.ply")));
  EXPECT_EQ(content(path("s.json")).find("\"singular_points\": []"), std::string::npos);
}

TEST_F(Program, ChartsAreGlued) {
  ASSERT_EQ(run("trace " + problem(R"({"projective": {"variables": ["x","y","z"], "equations": ["x^3*y+y^3*z+z^3*x"]},
                                       "triangulation": {"edge_length": 0.25}})") +
                " -o " + path("k.noff") + " --stats " + path("s.json")),
            0)
      << output_;
  EXPECT_TRUE(says("closed orientable surface, 1 component, Euler characteristic -4, genus 3")) << output_;
  EXPECT_NE(content(path("s.json")).find("\"seams\""), std::string::npos);
  EXPECT_EQ(run("check " + path("k.noff")), 0);
  EXPECT_TRUE(says("genus 3") && says("R^9")) << output_;
  // Clebsch's cubic surface: a one-sided surface from equations.
  ASSERT_EQ(run("trace " + problem(R"({"projective": {"variables": ["x","y","z","w"], "field": "real",
                                       "equations": ["x^3+y^3+z^3+w^3-(x+y+z+w)^3"]},
                                       "triangulation": {"edge_length": 0.1}})")),
            0)
      << output_;
  EXPECT_TRUE(says("closed non-orientable surface, 1 component, Euler characteristic -5") && says("H1 = Z^6 + Z/2"))
      << output_;
}

TEST_F(Program, ChartsThatDoNotFitTogetherAreRefused) {
  const std::string arguments = " -o " + path("x.off");
  const std::string quartic = R"({"projective": {"variables": ["x","y","z"], "equations": ["x^3*y+y^3*z+z^3*x"]},
    "triangulation": {"edge_length": 0.9}})";
  EXPECT_EQ(run("trace " + problem(quartic) + arguments), 3) << output_;
  EXPECT_TRUE(says("do not fit together") && says("smaller edge length")) << output_;
  EXPECT_FALSE(fs::exists(path("x.off")));
  EXPECT_EQ(run("trace " + problem(quartic) + " --edge-length 0.3 --max-simplices 2000" + arguments), 2) << output_;
  EXPECT_TRUE(fs::exists(path("x.off")));
  EXPECT_EQ(run("trace " + problem(quartic) + " --mesh cells" + arguments), 1);
  EXPECT_EQ(run("triangulate " + problem(quartic) + arguments), 1);
  EXPECT_EQ(run("trace " + problem(R"({"projective": {"variables": ["x","y","z"], "equations": ["x^3*y+y^2"]}})")), 1);
  EXPECT_TRUE(says("projective")) << output_;
}

TEST_F(Program, CertifiedAwayFromTheBoundary) {
  ASSERT_EQ(run("triangulate " + problem(R"({"variables": ["x","y","z"], "equations": ["x^2+y^2-z^2-1"],
                "inequalities": ["1-z^2"], "box": [[-5,5],[-5,5],[-5,5]], "reach": 1,
                "triangulation": {"edge_length": 0.4}})") +
                " --stats " + path("s.json")),
            0)
      << output_;
  EXPECT_TRUE(says("certified away from the boundary") && says("Euler characteristic 0")) << output_;
  EXPECT_NE(content(path("s.json")).find("\"away_from_boundary\": true"), std::string::npos);
  EXPECT_EQ(run("triangulate " + problem(R"({"named": {"name": "klein_bottle"}, "inequalities": ["-1 - x1^2"],
                                             "triangulation": {"edge_length": 0.4}})")),
            1);
  EXPECT_TRUE(says("outside the inequalities")) << output_;
}

TEST_F(Program, AMeshThatIsNoManifoldIsStatusThree) {
  std::ofstream(path("book.off")) << "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 1 4\n";
  EXPECT_EQ(run("check " + path("book.off")), 3);
  EXPECT_TRUE(says("not a manifold")) << output_;
  std::ofstream(path("cut.off")) << "OFF\n5 3 0\n0 0 0\n1 0";
  EXPECT_EQ(run("check " + path("cut.off")), 1);
  EXPECT_TRUE(says("cut.off")) << output_;
}

TEST_F(Program, PrintsTheParametersOfThePaper) {
  ASSERT_EQ(run("parameters --ambient 3 --intrinsic 2 --stats " + path("p.json")), 0) << output_;
  for (const char* text : {"L/rch", "(12)", "as printed", "corrected", "-31.49", "-33.88", "alpha_1"})
    EXPECT_TRUE(says(text)) << text << output_;
  const std::string stats = content(path("p.json"));
  for (const char* text : {"\"ambient_dim\": 3", "\"intrinsic_dim\": 2", "\"symbol\": \"c~\"", "\"equation\": \"(6)\"",
                           "\"meaning\": ", "\"log10_as_printed\": -31.4", "\"log10_corrected\": -33.8"})
    EXPECT_NE(stats.find(text), std::string::npos) << text << stats;
  EXPECT_EQ(run("parameters --ambient 3 --intrinsic 3"), 1);
  EXPECT_TRUE(says("intrinsic dimension < ambient dimension")) << output_;
  EXPECT_EQ(run("parameters --ambient 1000 --intrinsic 2"), 1);
  EXPECT_TRUE(says("140")) << output_;
  EXPECT_EQ(run("parameters --ambient 3"), 1);
  EXPECT_TRUE(says("--intrinsic")) << output_;
  EXPECT_EQ(run("parameters --ambient three --intrinsic 2"), 1);
  EXPECT_EQ(run("parameters --ambient 3 --intrinsic 2 --stats " + path("no/folder/p.json")), 1);
}

TEST_F(Program, SolidsAroundAndInsideAManifold) {
  const std::string sphere = R"({"named": {"name": "sphere"}, "triangulation": {"edge_length": 0.5}})";
  ASSERT_EQ(run("triangulate " + problem(sphere) + " --ambient " + path("a.vtu") + " --inside " + path("in.mesh") +
                " --stats " + path("s.json")),
            0)
      << output_;
  EXPECT_TRUE(says("quality: thickness worst")) << output_;
  EXPECT_NE(content(path("s.json")).find("\"thickness_median\""), std::string::npos);
  EXPECT_EQ(run("check " + path("in.mesh")), 0);  // a ball
  EXPECT_TRUE(says("1 boundary component") && says("Euler characteristic 1")) << output_;
  EXPECT_EQ(run("check " + path("a.vtu")), 0);  // a thick sphere
  EXPECT_TRUE(says("2 boundary components") && says("Euler characteristic 2")) << output_;

  const std::string circle = R"({"named": {"name": "sphere", "intrinsic_dim": 1, "ambient_dim": 4},
    "triangulation": {"edge_length": 0.2}})";
  EXPECT_EQ(run("triangulate " + problem(circle) + " --ambient " + path("b.vtu")), 1);
  EXPECT_TRUE(says(".noff")) << output_;
  EXPECT_EQ(run("triangulate " + problem(circle) + " --inside " + path("b.noff")), 1);
  EXPECT_TRUE(says("no inside")) << output_;
  EXPECT_EQ(files("b."), 0);
  EXPECT_EQ(run("triangulate " + problem(R"({"named": {"name": "so3_matrices"}})") + " --ambient " + path("b.noff")),
            1);
  EXPECT_TRUE(says("R^9")) << output_;
}

TEST_F(Program, HelpAndVersion) {
  EXPECT_EQ(run("--help"), 0);
  EXPECT_TRUE(says("trace") && says("check") && says("parameters"));
  EXPECT_EQ(run("trace --help"), 0);
  EXPECT_TRUE(says("--edge-length"));
  EXPECT_EQ(run("--version"), 0);
  EXPECT_TRUE(says("whitney 0."));
}

constexpr const char* kKleinBottle = R"json({"parametrization": {"parameters": ["u","v"],
  "domain": [[0,"2*pi"],[0,"2*pi"]],
  "map": ["(2+cos(v))*cos(u)", "(2+cos(v))*sin(u)", "sin(v)*cos(u/2)", "sin(v)*sin(u/2)"]},
  "triangulation": {"edge_length": 0.4}})json";

TEST_F(Program, TriangulatesTheKleinBottle) {
  ASSERT_EQ(run("triangulate " + problem(kKleinBottle) + " -o " + path("k.noff") + " --stats " + path("s.json")), 0)
      << output_;
  EXPECT_TRUE(says("certified")) << output_;
  EXPECT_TRUE(says("an estimate") && says("the errors of the feet")) << output_;
  EXPECT_TRUE(says("closed non-orientable surface, 1 component, Euler characteristic 0")) << output_;
  EXPECT_TRUE(says("H1 = Z + Z/2")) << output_;
  const std::string stats = content(path("s.json"));
  for (const char* key :
       {"\"verdict\": \"certified\"", "\"reach_source\": \"estimated\"", "\"margin_min\"", "\"hausdorff_bound\"",
        "\"orientable\": false", "\"rounds\"", "\"displacement_max\"", "\"certify\"", "\"perturb\""})
    EXPECT_NE(stats.find(key), std::string::npos) << key;
  EXPECT_EQ(run("check " + path("k.noff")), 0);
  EXPECT_TRUE(says("closed non-orientable surface")) << output_;
}

TEST_F(Program, TriangulatesFromEquationsWithTheCallersReach) {
  const std::string circle = R"("variables": ["x","y"], "equations": ["x^2+y^2-1"], "box": [[-2,2],[-2,2]])";
  ASSERT_EQ(run("triangulate " + problem("{" + circle + R"(, "reach": 1})") + " -o " + path("c.noff")), 0) << output_;
  EXPECT_TRUE(says("certified")) << output_;
  EXPECT_TRUE(says("as the caller says") && says("what a model says")) << output_;
  EXPECT_TRUE(says("closed orientable curve")) << output_;
  // Without an edge length one is searched for. With a reach that the feet contradict:
  EXPECT_EQ(run("triangulate " + problem("{" + circle + R"(, "reach": 3})") + " --edge-length 0.3"), 3) << output_;
  EXPECT_TRUE(says("modelled and not proved, suggest a reach of at most")) << output_;
}

TEST_F(Program, SaysWhatStandsInTheWayOfTheCertificate) {
  const std::string sphere = R"({"named": {"name": "sphere", "intrinsic_dim": 2, "ambient_dim": 3}})";
  EXPECT_EQ(
      run("triangulate " + problem(sphere) + " --edge-length 2 -o " + path("s.off") + " --stats " + path("s.json")), 3)
      << output_;
  EXPECT_TRUE(says("--edge-length 1")) << output_;  // what to try next
  EXPECT_NE(content(path("s.json")).find("\"reason\": \""), std::string::npos);
  EXPECT_EQ(run("triangulate " + problem(sphere) + " --edge-length 0.5 --scheme none"), 3) << output_;
  EXPECT_TRUE(says("violated")) << output_;  // an edge that the sphere crosses twice
  const std::string in_r4 = R"({"named": {"name": "sphere", "intrinsic_dim": 2, "ambient_dim": 4}})";
  EXPECT_EQ(run("triangulate " + problem(in_r4) + " --edge-length 0.3 --scheme none"), 3) << output_;
  EXPECT_TRUE(says("not certified")) << output_;
  EXPECT_TRUE(says("separation (A+)")) << output_;
  EXPECT_EQ(run("triangulate " + problem(sphere) + " --edge-length 2 --auto-refine"), 0) << output_;
  EXPECT_TRUE(says("refined")) << output_;
  EXPECT_EQ(run("triangulate " + problem(sphere) + " --edge-length 0.1 --max-simplices 50"), 2) << output_;
  EXPECT_TRUE(says("max_simplices")) << output_;
}

TEST_F(Program, TriangulateRefusesWhatIsNoClosedSubmanifold) {
  EXPECT_EQ(run("triangulate " + problem(R"json({"variables": ["x","y"], "equations": ["(x^2+y^2)^2 - x^2 + y^2"],
                                             "box": [[-2,2],[-2,2]]})json")),
            1);
  EXPECT_TRUE(says("crosses itself")) << output_;
  EXPECT_EQ(run("triangulate " + problem(R"json({"variables": ["x","y","z"], "equations": ["z"], "reach": 1,
                                             "box": [[-1,1],[-1,1],[-1,1]]})json") +
                " -o " + path("p.off")),
            1);
  EXPECT_TRUE(says("problem.json: the manifold leaves the box, at (")) << output_;
  EXPECT_EQ(files("p.off"), 0);
}

TEST_F(Program, TriangulateNamesBadInput) {
  EXPECT_EQ(run("triangulate " + problem(R"({"named": {"name": "sphere"}})") + " -o " + path("x.xyz")), 1);
  EXPECT_EQ(run("triangulate " + problem(R"({"named": {"name": "moebius"}})")), 1);
  EXPECT_TRUE(says("moebius")) << output_;
  EXPECT_EQ(run("triangulate " + problem(R"({"named": {"name": "sphere"}, "reach": -1})")), 1);
  EXPECT_TRUE(says("reach")) << output_;
  EXPECT_EQ(run("triangulate " + problem(R"({"named": {"name": "sphere"}, "seed_points": [[0,0,0]]})")), 1) << output_;
  EXPECT_TRUE(says("seed")) << output_;
  EXPECT_EQ(run("triangulate " + path("nowhere.json")), 1);
  EXPECT_TRUE(says("nowhere.json")) << output_;
}

TEST_F(Program, AnOutputNeverReplacesTheInputOrAnotherOutput) {
  const std::string file = problem(kTorus), before = content(file);
  EXPECT_EQ(run("trace " + file + " --stats " + file), 1);
  EXPECT_TRUE(says("this is the input")) << output_;
  EXPECT_EQ(run("trace " + file + " -o " + path("a.off") + " -o " + path("./a.off")), 1);
  EXPECT_TRUE(says("two outputs")) << output_;
  EXPECT_EQ(run("triangulate " + file + " --stats " + path("s.json") + " -o " + path("s.json")), 1);
  EXPECT_EQ(run("trace " + file + " --strata " + path("p.noff") + " -o " + path("p_0.noff")), 1);
  EXPECT_TRUE(says("stratum")) << output_;
  fs::create_directories(path("folder.off"));
  EXPECT_EQ(run("trace " + file + " -o " + path("folder.off")), 1);
  EXPECT_TRUE(says("folder of this name")) << output_;
  EXPECT_EQ(content(file), before);
  EXPECT_EQ(files("a.off") + files("s.json") + files("p_0"), 0);
}

TEST_F(Program, MemoryAndTopologyLevels) {
  EXPECT_EQ(run("trace " + problem(kTorus) + " --topology euler -o " + path("t.off") + " --stats " + path("s.json")),
            0);
  EXPECT_TRUE(says("Euler characteristic 0") && !says("homology")) << output_;
  EXPECT_NE(content(path("s.json")).find("\"homology_z\": null"), std::string::npos);
  EXPECT_EQ(run("trace " + problem(kTorus) + " --topology none --stats " + path("s.json")), 0);
  EXPECT_NE(content(path("s.json")).find("\"euler_characteristic\": null"), std::string::npos);
  // The 3-sphere at this edge length is found within 150 MB, its topology is not.
  EXPECT_EQ(run("trace " + problem(R"({"named": {"name": "sphere", "intrinsic_dim": 3},
                                       "triangulation": {"edge_length": 0.08}})") +
                " --memory-limit 300M -o " + path("s3.noff") + " --stats " + path("s.json")),
            2)
      << output_;
  EXPECT_TRUE(says("memory_limit")) << output_;
  EXPECT_TRUE(says("left out: ") && says("would take about")) << output_;
  EXPECT_TRUE(fs::exists(path("s3.noff")));
  EXPECT_NE(content(path("s.json")).find("\"left_out\": [\n    {"), std::string::npos);
  EXPECT_EQ(run("trace " + problem(kTorus) + " --memory-limit lots"), 1);
}

TEST_F(Program, TheVerdictSaysWhatItRestsOn) {
  ASSERT_EQ(run("triangulate " + problem(R"({"variables": ["x","y"], "equations": ["x^2+y^2-1"],
                "box": [[-2,2],[-2,2]], "reach": 1, "triangulation": {"edge_length": 0.3}})") +
                " --stats " + path("s.json")),
            0)
      << output_;
  EXPECT_TRUE(says("components of the manifold that the seeds lie on") && says("likely all, not proved")) << output_;
  EXPECT_TRUE(says("the errors of the feet are at most what a model says")) << output_;
  const std::string stats = content(path("s.json"));
  for (const char* key : {"\"reach_source\": \"caller\"", "\"feet_source\": \"modelled\"", "\"components\": \"seeds_"})
    EXPECT_NE(stats.find(key), std::string::npos) << key;
}

TEST_F(Program, NoTextSpeaksOfWhatIsNotThereYet) {
  EXPECT_EQ(run("trace " + problem(R"({"named": {"name": "klein_quartic"}})")), 1);
  EXPECT_TRUE(says("projective") && !says("does not have yet")) << output_;
}

}  // namespace

#endif
