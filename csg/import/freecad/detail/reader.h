#pragma once
// From the objects of a document to solids.
//
// Each object is made once, in the frame of what holds it: a body's features in
// the body's, the parts of a group in the group's. It is made by parameter if
// its maker can, and else by its boundary. Makers give nothing where there is
// no CSG form, and say why. Links lead to other files, too: each file has a
// document and a reader of its own, and all readers of an import share a state.

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "csg/import/freecad/detail/document.h"
#include "csg/import/freecad/detail/outline.h"
#include "csg/import/freecad/detail/solid_maker.h"
#include "csg/import/freecad/freecad_file.h"

namespace lamina::csg::freecad {

class Reader;

// What the readers of all files of an import share.
struct ImportState {
  ImportState(const FreecadOptions& asked, Arena& arena);

  const FreecadOptions& options;
  SolidMaker maker;
  FreecadModel model;
  std::size_t corners = 0;  // cut for outlines, also for none
  // What is being made, each for the one before it.
  std::vector<const Object*> open;
  // By path; null where there is no such file.
  std::map<std::string_view, std::unique_ptr<Reader>> readers;
  std::deque<std::string> linked_bytes;  // of the files that links name
};

class Reader {
 public:
  // bytes, path  of the file; both must live as long as the reader
  Reader(std::string_view bytes, std::string_view path, ImportState& state);

  // Makes what the file shows, or the part that the options name.
  void read();

  std::vector<FreecadPart> parts() const;

 private:
  using Made = std::optional<Solid>;
  // why  gets the reason where there is no CSG form
  using Make = Made (Reader::*)(const Object&, std::string& why);

  // --- reader.cpp -----------------------------------------------------------
  // The object in the frame of what holds it; nothing where it has no volume.
  Made make(const Object& object);
  Made make(std::string_view name);
  Made make_anew(const Object& object, std::string& why);
  std::vector<Solid> make_part(std::string_view name);
  std::vector<Solid> make_all_shown();
  static Make maker_of(const Object& object);
  static bool is_part(const Object& object);
  static bool is_group(const Object& object);
  // A reference to what other bodies have.
  static bool is_binder(const Object& object);
  // Curves, faces and helps to draw, which enclose nothing.
  bool is_flat(const Object& object) const;
  bool makes_surface(const Object& extrusion_or_revolution) const;
  Made by_boundary(const Object& object, const std::string& why);
  // Appends the solids of these objects that are shown and that no object is
  // made of. Names what is left out.
  void make_shown(const std::vector<const Object*>& objects,
                  std::vector<Solid>& solids);
  void report_left_out(const Object& object);
  // One note that names all of them, if there are any.
  void note_all(std::string_view what,
                const std::vector<const Object*>& objects);
  // What a group, a body or an array of links holds.
  static std::vector<std::string_view> members_of(const Object& object);
  std::vector<std::string_view> operands_of(const Object& object) const;
  // Throws FormatError where an object holds itself or is made of itself, over
  // whatever others: none of these would be shown, nor what else they hold.
  void require_no_ring() const;
  void find_operands();
  // What the object is made of and, of that, in turn.
  void claim_operands(const Object& shown);
  // What the group shows. Names what it hides and what is not there.
  std::vector<const Object*> objects_of(const Object& group);

  Made make_group(const Object& object, std::string& why);
  Made make_link(const Object& object, std::string& why);
  // What a link stands for, at its place in the frame of the link.
  //
  // keeps_place  whether the target's own placement counts
  Made make_target(const ObjectLink& link, bool keeps_place, std::string& why);
  // The object at the end of a link's path; null where there is none. Those on
  // the way to it, but the first, place it by `frame`.
  const Object* follow(const Object& first, std::string_view path, Mat4& frame,
                       std::string& why) const;
  // The reader of the file, which may be this one; null where there is no such
  // file.
  Reader* reader_of(std::string_view file);
  // Places `target` as often as the array says.
  Made make_link_array(const Object& object, const Solid& target,
                       std::string& why);

  // --- part_features.cpp ----------------------------------------------------
  Made make_part_primitive(const Object& object, std::string& why);
  // A cut, a fusion, a common part or a compound.
  Made make_boolean(const Object& object, std::string& why);
  Made make_mirroring(const Object& object, std::string& why);
  Made make_extrusion(const Object& object, std::string& why);
  Made make_part_revolution(const Object& object, std::string& why);
  // All or, where one has no volume, nothing.
  std::optional<std::vector<Solid>> make_operands(
      const std::vector<std::string_view>& names, std::string& why);
  // Stays; null where there is none. Each is read once for an error.
  const Outline* outline_of(std::string_view name, double error,
                            std::string& why);
  struct Turn {
    Vec3 base;
    Vec3 axis;
    double angle_deg = 360;
    bool is_symmetric = false;  // about the outline's plane
    bool is_reversed = false;
  };
  Made revolve(const Outline& outline, const Turn& turn, std::string& why);

  // --- part_design.cpp ------------------------------------------------------
  // The tip and, beside it, the solids that the body shows and binds.
  Made make_body(const Object& object, std::string& why);
  Made make_base(const Object& object, std::string& why);
  Made make_body_boolean(const Object& object, std::string& why);
  // What stands before the feature, and what it adds or takes away.
  Made make_feature(const Object& object, std::string& why);
  Made make_tool(const Object& object, std::string& why);
  // Whether the feature adds its tool; else it takes it away.
  static bool adds(const Object& object);
  Made make_prism_tool(const Object& object, std::string& why);
  Made make_revolution_tool(const Object& object, std::string& why);
  const Outline* profile_of(const Object& object, double error,
                            std::string& why);

  struct Entry {
    bool is_done = false;
    Made solid;
    std::string why;  // there is none
  };

  struct OutlineEntry {
    std::optional<Outline> outline;
    std::string why;  // there is none
  };

  Document document_;
  std::string_view path_;
  ImportState& state_;
  SolidMaker& maker_;
  FreecadModel& model_;
  std::map<const Object*, Entry> entries_;
  // By the chordal error, too.
  std::map<std::pair<const Object*, double>, OutlineEntry> outlines_;
  std::map<std::string_view, Solid> boundaries_;  // by their entries
  std::vector<const Object*> hidden_;             // of those that were left out
  std::vector<const Object*> flat_;               // likewise
  std::vector<const Object*> used_;               // likewise, and visible
  std::set<std::string_view> operands_;  // of other objects that are shown
  std::set<std::string_view> members_;   // of groups and bodies
  std::map<const Object*, std::vector<const Object*>> groups_;  // that hold it
};

}  // namespace lamina::csg::freecad
