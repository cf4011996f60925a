// --root, --allow-read, --no-import: every way in which a design or a command
// line can name a file, and every way to lead it out of the root.

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStl =
    "solid t\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 9 0\nvertex 9 0 0\n"
    "endloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 0 9\n"
    "endloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 9\nvertex 0 9 0\n"
    "endloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 9 0 0\nvertex 0 9 0\nvertex 0 0 9\n"
    "endloop\nendfacet\n"
    "endsolid\n";

// A folder to be confined to, and one beside it that is out of reach.
class Root : public testing::Test {
 protected:
  Root() {
    fs::create_directory(all_.file("root"));
    fs::create_directory(all_.file("beyond"));
  }

  std::string inside(const std::string& name) const {
    return all_.file("root/" + name);
  }
  std::string beyond(const std::string& name) const {
    return all_.file("beyond/" + name);
  }

  // In the root, with --root.
  support::ProcessResult run_confined(
      std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--root", "."});
    return support::run_process(command(std::move(arguments)),
                                all_.file("root"));
  }

  std::size_t count_beyond() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(all_.file("beyond")), {}));
  }

  support::TemporaryFolder all_;
};

// --- What a design names ----------------------------------------------------

struct Naming {
  const char* name;
  const char* extension;
  const char* design;  // {}: the file
};

constexpr Naming kNamings[] = {
    {"include", "scad", "include <{}>\n"},
    {"use", "scad", "use <{}>\n"},
    {"font", "ttf", "use <{}>\n"},
    {"import_stl", "stl", "import(\"{}\");\n"},
    {"import_off", "off", "import(\"{}\");\n"},
    {"import_obj", "obj", "import(\"{}\");\n"},
    {"import_amf", "amf", "import(\"{}\");\n"},
    {"import_3mf", "3mf", "import(\"{}\");\n"},
    {"import_dxf", "dxf", "import(\"{}\");\n"},
    {"import_svg", "svg", "import(\"{}\");\n"},
    {"import_unknown", "xyz", "import(\"{}\");\n"},
    {"old_import_stl", "stl", "import_stl(\"{}\");\n"},
    {"old_import_off", "off", "import_off(\"{}\");\n"},
    {"old_import_dxf", "dxf", "import_dxf(\"{}\");\n"},
    {"old_parameter", "stl", "import(filename = \"{}\");\n"},
    {"json", "json", "echo(import(\"{}\"));\n"},
    {"surface_dat", "dat", "surface(\"{}\");\n"},
    {"surface_png", "png", "surface(\"{}\");\n"},
    {"dxf_dim", "dxf", "echo(dxf_dim(file = \"{}\"));\n"},
    {"dxf_cross", "dxf", "echo(dxf_cross(file = \"{}\"));\n"},
    {"linear_extrude", "dxf", "linear_extrude(file = \"{}\");\n"},
    {"rotate_extrude", "dxf", "rotate_extrude(file = \"{}\");\n"},
};

class RootNaming : public Root, public testing::WithParamInterface<Naming> {
 protected:
  std::string file_name() const {
    return fmt::format("f.{}", GetParam().extension);
  }
  // What a design says to reach ../beyond/f.…, which need not be there.
  std::vector<std::string> escapes() {
    fs::create_symlink(beyond(file_name()), inside(file_name()));
    fs::create_symlink("../beyond/" + file_name(), inside("r-" + file_name()));
    fs::create_directory_symlink("../beyond", inside("folder"));
    fs::create_symlink("folder/" + file_name(), inside("2-" + file_name()));
    fs::create_directory(inside("sub"));
    return {"../beyond/" + file_name(),
            beyond(file_name()),
            inside("../beyond/" + file_name()),
            "./sub/../../beyond/" + file_name(),
            file_name(),
            "r-" + file_name(),
            "folder/" + file_name(),
            "2-" + file_name(),
            "folder/../../beyond/" + file_name()};
  }
  support::ProcessResult run_naming(const std::string& file,
                                    const std::string& output) {
    all_.write("root/d.scad",
               "\n" + fmt::format(fmt::runtime(GetParam().design), file));
    return run_confined({"d.scad", "-o", output});
  }
};

TEST_P(RootNaming, LeadsNowhereElseAndTellsNothing) {
  for (const std::string& file : escapes()) {
    const std::string output =
        std::string(GetParam().name) == "json" ? "o.echo" : "o.csg";
    all_.write("beyond/" + file_name(), "secret(\"1\");");
    const auto there = run_naming(file, output);
    EXPECT_EQ(there.status, 1) << file << "\n" << there.errors;
    // Messages name files from the root.
    const std::string shown =
        file.starts_with(inside("")) ? file.substr(inside("").size()) : file;
    EXPECT_NE(there.errors.find(
                  fmt::format("error: '{}' is outside of --root", shown)),
              std::string::npos)
        << there.errors;
    EXPECT_NE(there.errors.find("d.scad:2:"), std::string::npos)
        << there.errors;
    EXPECT_FALSE(fs::exists(inside(output)));
    // Nothing but its own words.
    if (file.find("beyond") == std::string::npos) {
      EXPECT_EQ(there.errors.find("beyond"), std::string::npos) << there.errors;
    }
    fs::remove(beyond(file_name()));
    const auto missing = run_naming(file, output);
    EXPECT_EQ(missing.status, 1) << file;
    EXPECT_EQ(missing.errors, there.errors) << "shows whether it is there";
    EXPECT_EQ(missing.output, there.output);
  }
}

TEST_P(RootNaming, FindsWhatIsInside) {
  all_.write("root/" + file_name(), "");
  fs::create_symlink(file_name(), inside("r-" + file_name()));
  fs::create_symlink(inside(file_name()), inside("a-" + file_name()));
  fs::create_directory(inside("sub"));
  for (const std::string& file :
       {file_name(), "r-" + file_name(), "a-" + file_name(),
        inside(file_name()), "sub/../" + file_name(),
        "../root/" + file_name()}) {
    const auto result = run_naming(file, "o.echo");
    EXPECT_EQ(result.errors.find("--root"), std::string::npos) << file << "\n"
                                                               << result.errors;
    EXPECT_EQ(result.errors.find("an't open"), std::string::npos)
        << file << "\n"
        << result.errors;
  }
}

TEST_P(RootNaming, IsRefusedByNoImportWhereItIsData) {
  all_.write("root/" + file_name(), "");
  all_.write("root/d.scad",
             fmt::format(fmt::runtime(GetParam().design), file_name()));
  const auto result = support::run_process(
      command({"d.scad", "-o", "o.echo", "--no-import"}), all_.file("root"));
  const bool is_code = std::string(GetParam().extension) == "scad";
  EXPECT_EQ(result.status, is_code ? 0 : 1) << result.errors;
  EXPECT_EQ(result.errors.find("is not read: --no-import") == std::string::npos,
            is_code)
      << result.errors;
}

INSTANTIATE_TEST_SUITE_P(AllKinds, RootNaming, testing::ValuesIn(kNamings),
                         [](const auto& named) {
                           return std::string(named.param.name);
                         });

// --- What a command line names ----------------------------------------------

struct CommandLine {
  const char* name;
  // {}: a path that leads out of the root, where a good file stands.
  std::vector<std::string> words;
  const char* extension;
  bool is_output = false;
};

// Messages may reach the stranger, who need not know where the root is. `$R` is
// the root as it is given.
TEST_F(Root, IsNamedInNoMessage) {
  constexpr const char* kFaultyDxf = "garbage\n0\nSECTION\n0\nEOF\n";
  constexpr const char* kEmptyDxf =
      "0\nSECTION\n2\nENTITIES\n0\nINSERT\n2\nnone\n0\nENDSEC\n0\nEOF\n";
  all_.write(
      "root/a.scad",
      "include <b.scad>\nimport(\"none.stl\");\nsurface(\"none.dat\");\n"
      "import(\"bad.stl\");\nx = import(\"none.json\");\n"
      "import(\"bad.dxf\");\nimport(\"empty.dxf\");\nimport(\"none.svg\");\n"
      "import(\"x.xyz\");\ncube(1);\n");
  all_.write("root/b.scad", "n = 0;\ninclude <none.scad>\nunknown();\n");
  all_.write("root/font.scad", "use <none.ttf>\n");
  all_.write("root/bad.stl", "solid\nfacet\n");
  all_.write("root/bad.dxf", kFaultyDxf);
  all_.write("root/empty.dxf", kEmptyDxf);
  all_.write("root/t.csv", "name,n\na,1\nb,2\n");
  all_.write("root/s.stl", kStl);
  all_.write("root/s.scad", "import(\"s.stl\");\n");
  all_.write("root/island.scad",
             "cube(1);\ntranslate([0,0,3]) cube([3,.05,2]);\n");
  fs::create_directory_symlink("root", all_.file("link"));
  struct Run {
    std::vector<std::string> words;
    std::string told;  // among others
  };
  const std::vector<Run> runs = {
      {{"$R/a.scad", "-o", "$R/a.slc", "--no-strict"}, "b.scad:3:1: warning"},
      {{"$R/a.scad", "-o", "$R/a.slc", "--no-strict"}, "`bad.dxf'"},
      {{"$R/a.scad", "-o", "$R/a.slc", "--no-strict"}, "\"empty.dxf\""},
      {{"$R/a.scad", "-o", "$R/a.echo", "--no-strict"}, "none.scad"},
      {{"$R/c.scad", "-o", "$R/c.slc"}, "'c.scad'"},
      {{"$R/font.scad", "-o", "$R/a.slc"}, "'none.ttf'"},
      {{"$R/s.scad", "-o", "$R/s.slc", "--decimate", "0.1"}, "\"s.stl\": 4 of"},
      {{"$R/s.scad", "-o", "$R/s.slc"}, "s.slc: "},
      {{"$R/s.scad", "-o", "$R/s.scad/s.slc"}, "'s.scad/s.slc'"},
      {{"$R/s.scad", "-o", "$R/s.slc", "-d", "$R/s.slc"}, "'s.slc'"},
      {{"$R/a.scad", "$R/b.scad", "-o", "$R/{name}.slc"}, "a.scad: "},
      {{"batch", "$R/b.scad", "--table", "$R/t.csv", "-o", "$R/{name}.slc"},
       "t.csv:2: a: "},
      {{"check", "$R/island.scad"}, "by island.scad:2:"},
      {{"check", "--json", "$R/island.scad"}, "island.scad:2:"},
      {{"inspect", "$R/island.scad"}, "island.scad"},
      {{"inspect", "--json", "$R/island.scad"}, "\"island.scad\""},
      {{"inspect", "$R/s.stl"}, "s.stl"},
      {{"compare", "$R/island.scad", "$R/s.stl", "--report", "$R/r.json"},
       "island.scad"},
      {{"compare", "$R/s.xyz", "$R/s.stl"}, "'s.xyz' is no file"},
      {{"view", "$R/island.scad", "-o", "$R/v.html"}, "print: "},
  };
  // Neither its own name nor that of what is around it.
  const std::string around = fs::path(all_.path()).filename();
  const auto expect_untold = [&](const std::string& text) {
    for (const std::string& name :
         {around, std::string("root/"), std::string("link/")}) {
      EXPECT_EQ(text.find(name), std::string::npos) << text;
    }
  };
  for (const std::string folder : {"root", "link"}) {
    const std::string absolute = all_.file(folder);
    for (const auto& [here, root] :
         {std::pair(all_.file("beyond"), absolute),
          std::pair(all_.file("beyond"), "../" + folder),
          std::pair(std::string("/"), absolute),
          std::pair(std::string("/"), absolute.substr(1)),
          std::pair(all_.file(""), absolute), std::pair(all_.file(""), folder),
          std::pair(absolute, absolute)}) {
      for (const Run& one : runs) {
        std::vector<std::string> words = one.words;
        for (std::string& word : words) {
          if (word.starts_with("$R")) word.replace(0, 2, root);
        }
        words.insert(words.end(), {"--root", root});
        const auto result = support::run_process(command(words), here);
        SCOPED_TRACE(fmt::format("{} in {}", fmt::join(words, " "), here));
        const std::string text = result.errors + result.output;
        expect_untold(text);
        if (one.words[0] != "view") {
          EXPECT_NE(text.find(one.told), std::string::npos) << text;
        }
        for (const char* made : {"a.echo", "v.html", "r.json"}) {
          if (!fs::exists(inside(made))) continue;
          expect_untold(support::read_file(inside(made)));
          fs::remove(inside(made));
        }
      }
    }
  }
}

// A message takes the time of its length, however often it names the root.
TEST_F(Root, IsTakenOutOfALongMessage) {
  all_.write("root/d.scad",
             fmt::format("s = \" {}\";\n"
                         "function doubled(s, n) =\n"
                         "  n == 0 ? s : doubled(str(s, s), n - 1);\n"
                         "assert(false, doubled(s, 20));\n",
                         inside("")));
  const auto result = run_confined({"d.scad", "-o", "o.slc"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.errors.find(all_.path()), std::string::npos);
}

// A name that comes as data can hold a NUL, at which the kernel would end it.
TEST_F(Root, ANameWithANulLeadsNowhere) {
  all_.write("beyond/f.json", "{\"word\": \"secret\"}");
  all_.write("beyond/f.svg", "<svg><rect width=\"1\" height=\"1\"/></svg>\n");
  const std::string up = "..\\u0000/beyond/f";
  all_.write("root/n.json", "{\"json\": \"" + up + ".json\", \"svg\": \"" + up +
                                ".svg\", \"none\": \"" + up + "-none.svg\"}");
  all_.write("root/p.json", "{\"parameterSets\": {\"s\": {\"f\": \"" + up +
                                ".svg\"}}, \"fileFormatVersion\": \"1\"}");
  all_.write("root/json.scad",
             "n = import(\"n.json\");\nd = import(n.json);\necho(d);\n");
  all_.write("root/svg.scad", "n = import(\"n.json\");\nimport(n.svg);\n");
  all_.write("root/none.scad", "n = import(\"n.json\");\nimport(n.none);\n");
  all_.write("root/set.scad", "f = \"\";  // file\nimport(f);\n");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"json.scad", "-o", "o.echo"},
        {"svg.scad", "-o", "o.svg"},
        {"none.scad", "-o", "o.svg"},
        {"set.scad", "-o", "o.svg", "-p", "p.json", "-P", "s"},
        {"batch", "set.scad", "--table", "p.json", "-o", "{name}.svg"}}) {
    const auto result = run_confined(words);
    EXPECT_EQ(result.status, 1) << words[0] << "\n" << result.errors;
    EXPECT_NE(result.errors.find("'..\\u0000/beyond/f"), std::string::npos)
        << result.errors;
    EXPECT_EQ(result.errors.find("secret"), std::string::npos);
  }
}

class RootWords : public Root, public testing::WithParamInterface<CommandLine> {
 protected:
  support::ProcessResult run_words(const std::string& file) const {
    std::vector<std::string> words;
    for (const std::string& word : GetParam().words) {
      words.push_back(fmt::format(fmt::runtime(word), file));
    }
    return run_confined(words);
  }
};

TEST_P(RootWords, LeadNowhereElse) {
  all_.write("root/d.scad", "width = 1;\ncube(width);\n");
  all_.write("root/d.stl", kStl);
  all_.write("root/t.csv", "name,width\na,2\n");
  ASSERT_EQ(run_confined({"d.scad", "-o", "a.slc"}).status, 0);
  const std::string name = fmt::format("f.{}", GetParam().extension);
  const std::string target = beyond(name);
  if (!GetParam().is_output) {
    const std::string extension = GetParam().extension;
    all_.write("beyond/" + name, extension == "csv" ? "name,width\na,2\n"
                                 : extension == "json"
                                     ? "{\"parameterSets\": {\"s\": {}}}"
                                 : extension == "stl" ? kStl
                                                      : "cube();");
    if (extension == "slc") {
      fs::copy_file(inside("a.slc"), target,
                    fs::copy_options::overwrite_existing);
    }
  }
  const std::size_t count = count_beyond();
  fs::create_symlink(target, inside(name));
  fs::create_directory_symlink("../beyond", inside("folder"));
  for (const std::string& file :
       {"../beyond/" + name, target, name, "folder/" + name}) {
    const auto result = run_words(file);
    EXPECT_EQ(result.status, 1) << file << "\n" << result.errors;
    EXPECT_NE(result.errors.find("is outside of --root"), std::string::npos)
        << file << "\n"
        << result.errors;
    EXPECT_EQ(count_beyond(), count) << file << " was written";
  }
}

const std::vector<CommandLine> kCommandLines = {
    {"design", {"{}", "-o", "o.slc"}, "scad"},
    {"mesh", {"{}", "-o", "o.slc"}, "stl"},
    {"output", {"d.scad", "-o", "{}"}, "slc", true},
    {"svg_output", {"d.scad", "-o", "{}"}, "svg", true},
    {"zip_output",
     {"d.scad", "-o", "{}", "--layer", "0.5"},
     "slices.3mf",
     true},
    {"images", {"d.scad", "-o", "{}", "--layer", "0.5"}, "png", true},
    {"csg", {"d.scad", "-o", "{}"}, "csg", true},
    {"echo", {"d.scad", "-o", "{}"}, "echo", true},
    {"ast", {"d.scad", "-o", "{}"}, "ast", true},
    {"dependencies", {"d.scad", "-o", "o.slc", "-d", "{}"}, "d", true},
    {"report", {"d.scad", "-o", "o.slc", "--report", "{}"}, "txt", true},
    {"parameters", {"d.scad", "-o", "o.slc", "-p", "{}", "-P", "s"}, "json"},
    {"printer", {"d.scad", "-o", "o.png", "--printer", "{}"}, "json"},
    {"table", {"batch", "d.scad", "--table", "{}", "-o", "{{row}}.slc"}, "csv"},
    {"sets", {"batch", "d.scad", "--table", "{}", "-o", "{{row}}.slc"}, "json"},
    {"pieces_design",
     {"batch", "{}", "--table", "t.csv", "-o", "{{row}}.slc"},
     "scad"},
    {"pieces_report",
     {"batch", "d.scad", "--table", "t.csv", "-o", "{{row}}.slc", "--report",
      "{}"},
     "csv",
     true},
    {"inspect", {"inspect", "{}"}, "slc"},
    {"inspect_design", {"inspect", "{}"}, "scad"},
    {"view", {"view", "{}", "-o", "o.png"}, "slc"},
    {"picture", {"view", "a.slc", "-o", "{}"}, "png", true},
    {"page", {"view", "a.slc", "-o", "{}"}, "html", true},
    {"compare_a", {"compare", "{}", "a.slc"}, "slc"},
    {"compare_b", {"compare", "a.slc", "{}"}, "scad"},
    {"compare_report",
     {"compare", "a.slc", "a.slc", "--report", "{}"},
     "txt",
     true},
    {"compare_picture",
     {"compare", "a.slc", "d.scad", "--png", "{}"},
     "png",
     true},
};
INSTANTIATE_TEST_SUITE_P(AllOptions, RootWords,
                         testing::ValuesIn(kCommandLines),
                         [](const auto& named) {
                           return std::string(named.param.name);
                         });

TEST_F(Root, CellsOfATableOpenNothing) {
  all_.write("root/d.scad", "size = [1];\ncube(size[0]);\n");
  for (const std::string word : {"include", "use"}) {
    for (const std::string& file : {beyond("f.scad"), inside("d.scad")}) {
      all_.write("root/t.csv",
                 fmt::format("name,size\na,[2]; {} <{}>\n", word, file));
      const auto error_of_cell = [&] {
        const auto result = run_confined(
            {"batch", "d.scad", "--table", "t.csv", "-o", "{name}.slc", "-q"});
        EXPECT_EQ(result.status, 1) << result.errors;
        return result.errors.substr(0, result.errors.find('\n'));
      };
      all_.write("beyond/f.scad", "secret(");
      const std::string there = error_of_cell();
      EXPECT_NE(there.find("a vector such as"), std::string::npos) << there;
      fs::remove(beyond("f.scad"));
      EXPECT_EQ(error_of_cell(), there) << "shows whether it is there";
    }
  }
}

TEST_F(Root, FoldersOfSeveralOutputsStayInside) {
  all_.write("root/d.scad", "cube(1);\n");
  all_.write("root/e.scad", "cube(1);\n");
  all_.write("root/t.csv", "name\na\n");
  fs::create_directory_symlink("../beyond", inside("folder"));
  for (const std::string& folder :
       {std::string("../beyond/new/"), std::string("folder/new/"),
        beyond("new/")}) {
    const auto several = run_confined({"d.scad", "e.scad", "-o", folder});
    EXPECT_EQ(several.status, 1) << several.errors;
    const auto pieces = run_confined(
        {"batch", "d.scad", "--table", "t.csv", "-o", folder + "{name}.slc"});
    EXPECT_EQ(pieces.status, 1) << pieces.errors;
    EXPECT_EQ(count_beyond(), 0U);
  }
  EXPECT_EQ(run_confined({"d.scad", "e.scad", "-o", "x/y/z/"}).status, 0);
  EXPECT_TRUE(fs::exists(inside("x/y/z/e.slc")));
}

// Designs are compiled side by side, and all want the folder.
TEST_F(Root, FoldersAreMadeByWhoeverIsFirst) {
  std::vector<std::string> designs;
  for (const char* name : {"a.scad", "b.scad", "c.scad", "d.scad"}) {
    all_.write(std::string("root/") + name, "cube(1);\n");
    designs.emplace_back(name);
  }
  for (int i = 0; i < 60; ++i) {
    std::vector<std::string> words = designs;
    const std::string folder = fmt::format("x{}/y/z/", i);
    words.insert(words.end(), {"-o", folder, "--threads", "4"});
    const auto result = run_confined(words);
    EXPECT_EQ(result.status, 0) << result.errors;
    EXPECT_TRUE(fs::exists(inside(folder + "d.slc")));
  }
}

// --- The root ---------------------------------------------------------------

TEST_F(Root, MayBeNamedInAnyWay) {
  all_.write("root/d.scad", "import(\"s.stl\");\n");
  all_.write("root/s.stl", kStl);
  fs::create_directory_symlink("root", all_.file("alias"));
  struct Way {
    std::string root;
    std::string design;
  };
  for (const Way& way :
       std::vector<Way>{{"root", "root/d.scad"},
                        {"root/", "root/d.scad"},
                        {"./beyond/../root", "root/d.scad"},
                        {all_.file("root"), "root/d.scad"},
                        {"alias", "alias/d.scad"},
                        {"alias", "root/d.scad"},
                        {"root", all_.file("root/d.scad")},
                        {all_.file("alias"), all_.file("alias/d.scad")},
                        {"/", "root/d.scad"},
                        {"/", "alias/d.scad"},
                        {".", "alias/d.scad"}}) {
    const auto result =
        run(all_, {way.design, "-o", way.design + ".slc", "--root", way.root});
    EXPECT_EQ(result.status, 0) << way.root << "\n" << result.errors;
    EXPECT_TRUE(fs::remove(inside("d.scad.slc"))) << way.root;
  }
}

TEST_F(Root, HasToBeAFolder) {
  all_.write("root/d.scad", "cube();\n");
  for (const char* const root : {"none", "root/d.scad", ""}) {
    const auto result =
        run(all_, {"root/d.scad", "-o", "o.slc", "--root", root});
    EXPECT_EQ(result.status, 2) << root << result.errors;
  }
  EXPECT_EQ(run(all_, {"root/d.scad", "--allow-read", "root"}).status, 2);
  EXPECT_EQ(run(all_, {"root/d.scad", "--root", "root", "--allow-read", "none"})
                .status,
            2);
}

TEST_F(Root, DoesNotGoWithWatchingAndOpenscad) {
  all_.write("root/d.scad", "cube();\n");
  EXPECT_EQ(run_confined({"d.scad", "--watch"}).status, 2);
  EXPECT_EQ(run_confined({"compare", "d.scad", "--against", "openscad"}).status,
            2);
}

TEST_F(Root, IsReadAsOnesOwnFolderIs) {
  // What is missing inside is reported as ever, and the run goes on.
  all_.write("root/d.scad",
             "include <none.scad>\nimport(\"none.stl\");\ncube(1);\n");
  const auto confined =
      run_confined({"d.scad", "-o", "a.slc", "-q", "--no-strict"});
  const auto free = support::run_process(
      command({"d.scad", "-o", "b.slc", "-q"}), all_.file("root"));
  EXPECT_EQ(confined.status, 0) << confined.errors;
  EXPECT_EQ(confined.errors, free.errors);
  EXPECT_EQ(support::read_file(inside("a.slc")),
            support::read_file(inside("b.slc")));
}

TEST_F(Root, AllowsToReadElsewhereButNotToWrite) {
  all_.write("beyond/lib.scad", "module m() import(\"part.stl\");\n");
  all_.write("beyond/part.stl", kStl);
  all_.write("root/d.scad", "use <../beyond/lib.scad>\nm();\n");
  fs::create_directory_symlink(all_.file("beyond"), inside("folder"));
  const std::vector<std::string> more = {"--allow-read", "../beyond"};
  const auto run_more = [&](std::vector<std::string> words) {
    words.insert(words.end(), more.begin(), more.end());
    return run_confined(std::move(words));
  };
  EXPECT_EQ(run_more({"d.scad", "-o", "o.slc"}).status, 0);
  const std::size_t count = count_beyond();
  for (const char* output : {"../beyond/o.slc", "folder/o.slc"}) {
    const auto result = run_more({"d.scad", "-o", output});
    EXPECT_EQ(result.status, 1) << result.errors;
    EXPECT_EQ(count_beyond(), count);
  }
}

TEST_F(Root, FindsLibrariesThatMayBeReadOnly) {
  all_.write("root/d.scad",
             "use <MCAD/boxes.scad>\nroundedBox([9,9,9],1,true);");
  const auto without = run_confined({"d.scad", "-o", "o.slc"});
  EXPECT_NE(without.errors.find("Can't open library 'MCAD/boxes.scad'."),
            std::string::npos)
      << without.errors;
  EXPECT_EQ(run_confined({"d.scad", "-o", "o.slc", "--allow-read",
                          "/usr/share/openscad/libraries"})
                .status,
            0);
}

TEST_F(Root, ReadsOnlyRegularFiles) {
  ASSERT_EQ(::mkfifo(inside("f.stl").c_str(), 0666), 0);
  ASSERT_EQ(::mkfifo(inside("f.json").c_str(), 0666), 0);
  ASSERT_EQ(::mkfifo(inside("o.slc").c_str(), 0666), 0);
  all_.write("root/d.scad",
             "import(\"f.stl\");\necho(import(\"f.json\"));\ncube(1);\n");
  EXPECT_EQ(run_confined({"d.scad", "-o", "a.slc", "--no-strict"}).status, 0);
  EXPECT_EQ(run_confined({"d.scad", "-o", "o.slc", "--no-strict"}).status, 1);
}

TEST_F(Root, WritesToStandardOutput) {
  all_.write("root/d.scad", "cube(1);\n");
  const auto result =
      run_confined({"d.scad", "-o", "-", "--export-format", "csg"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_NE(result.output.find("cube("), std::string::npos);
}

// --- Fonts ------------------------------------------------------------------

TEST_F(Root, FontsAreThoseThatMayBeRead) {
  all_.write("root/d.scad", "linear_extrude(1) text(\"Ag\");\n");
  const auto free = support::run_process(command({"d.scad", "-o", "a.slc"}),
                                         all_.file("root"));
  ASSERT_EQ(free.status, 0) << free.errors;
  const auto none = run_confined({"d.scad", "-o", "b.slc"});
  EXPECT_EQ(none.status, 1) << none.errors;
  EXPECT_NE(none.errors.find("Can't get font"), std::string::npos)
      << none.errors;
  const auto allowed = run_confined(
      {"d.scad", "-o", "c.slc", "--allow-read", "/usr/share/fonts"});
  EXPECT_EQ(allowed.status, 0) << allowed.errors;
  EXPECT_EQ(support::read_file(inside("a.slc")),
            support::read_file(inside("c.slc")));
}

TEST_F(Root, TheHintNamesAllFoldersOfFonts) {
  all_.write("root/d.scad", "linear_extrude(1) text(\"Ag\");\n");
  std::vector<std::string> words =
      command({"d.scad", "-q", "-o", "o.slc", "--root", "."});
  words.insert(words.begin(),
               {"/usr/bin/env", "OPENSCAD_FONT_PATH=/opt/a:/opt/b"});
  const auto result = support::run_process(words, all_.file("root"));
  EXPECT_EQ(result.status, 1) << result.errors;
  EXPECT_NE(result.errors.find("try --allow-read /usr/share/fonts "
                               "--allow-read /opt/a --allow-read /opt/b\n"),
            std::string::npos)
      << result.errors;
}

// Where HOME is the root, strangers write its rules of fonts.
TEST_F(Root, RulesOfFontsAtHomeAreNotRead) {
  all_.write("root/d.scad", "linear_extrude(1) text(\"Ag\");\n");
  const std::string rules = fmt::format(
      "<fontconfig><include>{}</include></fontconfig>", beyond("f.conf"));
  fs::create_directories(inside(".config/fontconfig"));
  all_.write("root/.config/fontconfig/fonts.conf", rules);
  all_.write("root/.fonts.conf", rules);
  const auto run_at_home = [&](const std::string& configuration) {
    std::vector<std::string> words =
        command({"d.scad", "-q", "-o", "o.slc", "--root", ".", "--allow-read",
                 "/usr/share/fonts"});
    words.insert(words.begin(),
                 {"/usr/bin/env", "HOME=" + inside(""), configuration});
    return support::run_process(words, all_.file("root"));
  };
  for (const std::string& configuration :
       {std::string("--unset=XDG_CONFIG_HOME"),
        "XDG_CONFIG_HOME=" + inside(".config")}) {
    all_.write("beyond/f.conf", "no rules");
    const auto there = run_at_home(configuration);
    EXPECT_EQ(there.status, 0) << there.errors;
    EXPECT_EQ(there.errors.find("f.conf"), std::string::npos) << there.errors;
    fs::remove(beyond("f.conf"));
    EXPECT_EQ(run_at_home(configuration).errors, there.errors);
  }
}

// --- Few descriptors --------------------------------------------------------

TEST_F(Root, DescriptorsThatEndAreAnError) {
  fs::create_directories(inside("a/b/c"));
  all_.write("root/a/b/c/part.scad", "echo(\"part\");\n");
  fs::create_directory_symlink("b", inside("a/link"));
  all_.write("root/j.json", "\"json\"");
  all_.write("root/d.scad",
             "include <a/link/c/part.scad>\necho(import(\"j.json\"));\n");
  ASSERT_EQ(run_confined({"d.scad", "-o", "o.echo"}).status, 0);
  const std::string whole = support::read_file(inside("o.echo"));
  EXPECT_NE(whole.find("part"), std::string::npos);
  int done = 0;
  for (int limit = 4; limit < 24; ++limit) {
    fs::remove(inside("o.echo"));
    std::vector<std::string> words =
        command({"d.scad", "-o", "o.echo", "--root", "."});
    words.insert(words.begin(),
                 {"/bin/sh", "-c",
                  fmt::format("ulimit -n {}; exec \"$@\"", limit), "sh"});
    const auto result = support::run_process(words, all_.file("root"));
    if (result.status == 0) {
      EXPECT_EQ(support::read_file(inside("o.echo")), whole) << limit;
      ++done;
      continue;
    }
    constexpr int kNoLibraries = 127;  // could be loaded
    if (result.status == kNoLibraries) continue;
    EXPECT_TRUE(result.status == 1 || result.status == 2)
        << limit << ": " << result.status;
    EXPECT_NE(result.errors.find("oo many open files"), std::string::npos)
        << limit << ": " << result.errors;
    EXPECT_FALSE(fs::exists(inside("o.echo"))) << limit;
  }
  EXPECT_GT(done, 0);
}

// --- Links that change meanwhile --------------------------------------------

// Puts in turn two links, or a folder and a link, in one place, until it goes.
class Swapper {
 public:
  explicit Swapper(std::function<void(bool)> swap)
      : thread_([this, swap = std::move(swap)] {
          for (bool is_good = false; !is_done_; is_good = !is_good) {
            swap(is_good);
            ++count_;
          }
        }) {}
  ~Swapper() {
    is_done_ = true;
    thread_.join();
    EXPECT_GT(count_, 100) << "hardly a race";
  }

 private:
  std::atomic<bool> is_done_ = false;
  std::atomic<int> count_ = 0;
  std::thread thread_;
};

TEST_F(Root, ASwappedLinkGainsNothing) {
  constexpr int kAttempts = 200;
  all_.write("root/good.json", "\"mine\"");
  all_.write("beyond/bad.json", "\"secret\"");
  all_.write("root/d.scad", "echo(import(\"f.json\"));\n");
  fs::create_symlink("good.json", inside("f.json"));
  const Swapper swapper([&](bool is_good) {
    fs::create_symlink(is_good ? "good.json" : beyond("bad.json"),
                       inside("next"));
    fs::rename(inside("next"), inside("f.json"));
  });
  for (int i = 0; i < kAttempts; ++i) {
    const auto result = run_confined({"d.scad", "-o", "o.echo"});
    EXPECT_EQ(result.errors.find("secret"), std::string::npos);
    if (result.status != 0) continue;
    EXPECT_EQ(support::read_file(inside("o.echo")).find("secret"),
              std::string::npos);
  }
}

TEST_F(Root, ASwappedFolderTakesNoOutput) {
  constexpr int kAttempts = 200;
  all_.write("root/d.scad", "echo(1);\n");
  fs::create_directory(inside("out"));
  fs::create_directory_symlink(all_.file("beyond"), inside("link"));
  const Swapper swapper([&](bool) {
    ::renameat2(AT_FDCWD, inside("out").c_str(), AT_FDCWD,
                inside("link").c_str(), RENAME_EXCHANGE);
  });
  for (int i = 0; i < kAttempts; ++i) {
    run_confined({"d.scad", "-o", "out/o.echo"});
    ASSERT_EQ(count_beyond(), 0U);
  }
}

}  // namespace
}  // namespace lamina::cli
