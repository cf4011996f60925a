#include "csg/import/freecad/detail/reader.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/matrix.hpp>

#include "base/file/format_error.h"
#include "csg/import/freecad/detail/primitives.h"
#include "csg/limits.h"

namespace lamina::csg::freecad {
namespace {

// What an object that is made of others calls them. What it names besides, as
// an axis, a support or the original of a copy, stays a part of its own.
constexpr std::array<std::string_view, 10> kOperandProperties = {
    "Base",  "Tool",  "Shapes",  "Links",    "Source",
    "Spine", "Faces", "Profile", "Sections", "BaseFeature"};

std::string shown(const Object& object) {
  return fmt::format("'{}' ({})", object.label(), object.type());
}

bool has_flat_type(const Object& object) {
  static const std::set<std::string_view> kTypes = {
      "Part::Plane",
      "Part::Line",
      "Part::Vertex",
      "Part::Circle",
      "Part::Ellipse",
      "Part::Polygon",
      "Part::RegularPolygon",
      "Part::Helix",
      "Part::Spiral",
      "Part::Face",
      "Part::Section",
      "PartDesign::Plane",
      "PartDesign::Line",
      "PartDesign::Point",
      "PartDesign::CoordinateSystem"};
  const std::string_view type = object.type();
  return type.starts_with("Sketcher::SketchObject") ||
         type.starts_with("Part::Part2DObject") || kTypes.contains(type);
}

// Not a table, a drawing, a material, a load.
bool has_geometry(const Object& object) {
  if (object.type().starts_with("Fem::")) return false;
  return object.value("Shape") || object.value("Mesh") ||
         object.value("Points") || object.has_transient_shape();
}

// A list of what is shown has the last element first; an element that it lacks
// is shown.
bool is_listed_hidden(const Object& object, std::size_t element) {
  const std::string_view shows = object.text("VisibilityList");
  return element < shows.size() && shows[shows.size() - 1 - element] == '0';
}

Mat4 scaling(Vec3 factors) {
  Mat4 matrix(1);
  for (int i = 0; i < 3; ++i) matrix[i][i] = factors[i];
  return matrix;
}

[[noreturn]] void fail_made_from_itself(const Object& object) {
  throw FormatError(
      fmt::format("FCStd, {} is made from itself", shown(object)));
}

}  // namespace

ImportState::ImportState(const FreecadOptions& asked, Arena& arena)
    : options(asked),
      maker(arena, {asked.range, asked.caller}, asked.chordal_error,
            asked.most_leaves) {}

Reader::Reader(std::string_view bytes, std::string_view path,
               ImportState& state)
    : document_(bytes),
      path_(path),
      state_(state),
      maker_(state.maker),
      model_(state.model) {
  find_operands();
}

void Reader::read() {
  try {
    const auto& part = state_.options.part;
    const std::vector<Solid> solids =
        part ? make_part(*part) : make_all_shown();
    // What shown objects are made of is not left out.
    std::erase_if(hidden_, [&](const Object* object) {
      return entries_.contains(object);
    });
    note_all("left out, as others that are shown are made of them", used_);
    note_all("hidden, so left out", hidden_);
    note_all("left out, as they enclose nothing", flat_);
    for (const Solid& solid : solids) {
      model_.nodes.push_back(solid.node);
      model_.leaves += solid.leaves;
    }
  } catch (const plane::LimitExceeded& fault) {
    if (state_.open.empty()) throw;
    throw plane::LimitExceeded(fmt::format(
        "{}, in {}", fault.diagnostic().message, shown(*state_.open.back())));
  }
}

std::vector<FreecadPart> Reader::parts() const {
  std::vector<FreecadPart> parts;
  for (const Object& object : document_.objects()) {
    if (!is_part(object) || is_flat(object)) continue;
    parts.push_back({std::string(object.name()), std::string(object.label()),
                     std::string(object.type()), object.is_visible()});
  }
  return parts;
}

std::vector<Solid> Reader::make_part(std::string_view name) {
  const Object* const part = document_.find_part(name);
  if (part == nullptr) {
    throw FormatError(fmt::format("FCStd, there is no part '{}'", name));
  }
  if (const Made solid = make(*part)) return {*solid};
  const std::string& why = entries_[part].why;
  throw FormatError(fmt::format("FCStd, {} is no solid{}{}", shown(*part),
                                why.empty() ? "" : ": ", why));
}

std::vector<Solid> Reader::make_all_shown() {
  model_.warnings = document_.warnings();
  require_no_ring();
  std::vector<const Object*> top;
  for (const Object& object : document_.objects()) {
    if (!members_.contains(object.name())) top.push_back(&object);
  }
  std::vector<Solid> solids;
  make_shown(top, solids);
  return solids;
}

// --- Which objects count ----------------------------------------------------

std::vector<std::string_view> Reader::members_of(const Object& object) {
  if (is_group(object)) {
    return object.links(object.value("Group") ? "Group" : "ElementList");
  }
  if (object.is_a("App::Link")) return object.links("ElementList");
  if (object.type().starts_with("PartDesign::")) return object.links("Group");
  return {};
}

// A primitive is made of its parameters, whatever else it names.
std::vector<std::string_view> Reader::operands_of(const Object& object) const {
  if (is_flat(object) || !is_part(object) || is_group(object) ||
      maker_of(object) == &Reader::make_part_primitive) {
    return {};
  }
  std::vector<std::string_view> names;
  if (object.type().starts_with("PartDesign::")) names = object.links("Group");
  for (const std::string_view property : kOperandProperties) {
    names.push_back(object.link(property));
    const auto listed = object.links(property);
    names.insert(names.end(), listed.begin(), listed.end());
  }
  return names;
}

// Walks from each object to what it holds and is made of.
void Reader::require_no_ring() const {
  struct Step {
    const Object* object;
    std::vector<std::string_view> parts;  // that are still to be walked to
  };
  std::vector<Step> way;
  std::map<const Object*, bool> is_on_way;  // of those that were walked to
  const auto walk_to = [&](const Object& object) {
    const auto [found, is_new] = is_on_way.try_emplace(&object, true);
    if (!is_new) {
      if (found->second) fail_made_from_itself(object);
      return;
    }
    std::vector<std::string_view> parts = members_of(object);
    const auto operands = operands_of(object);
    parts.insert(parts.end(), operands.begin(), operands.end());
    way.push_back({&object, std::move(parts)});
  };
  for (const Object& start : document_.objects()) {
    walk_to(start);
    while (!way.empty()) {
      Step& last = way.back();
      if (last.parts.empty()) {
        is_on_way[last.object] = false;
        way.pop_back();
        continue;
      }
      const Object* const part = document_.find(last.parts.back());
      last.parts.pop_back();
      if (part != nullptr) walk_to(*part);
    }
  }
}

// Drawings and views of a part are not made of it, and what is hidden leaves
// its operands to be shown, unless something shown is made of it in turn.
void Reader::find_operands() {
  std::set<std::string_view> features;  // of bodies
  for (const Object& object : document_.objects()) {
    for (const std::string_view name : members_of(object)) {
      members_.insert(name);
      if (!is_group(object)) {
        features.insert(name);
        continue;
      }
      const Object* const member = document_.find(name);
      if (member == nullptr) continue;
      std::vector<const Object*>& groups = groups_[member];
      if (!groups.empty() && groups.back() == &object) continue;
      groups.push_back(&object);
      if (groups.size() > kMostGroups) {
        throw plane::LimitExceeded(
            fmt::format("Too many groups: more than {} hold {}", kMostGroups,
                        shown(*member)));
      }
    }
  }
  // Where the file says what is shown, that alone decides.
  if (document_.has_view()) return;
  for (const Object& object : document_.objects()) {
    if (!object.is_visible() || features.contains(object.name())) continue;
    if (!object.is_a("Part::Mirroring")) {
      claim_operands(object);
    } else if (const Object* source = document_.find(object.link("Source"))) {
      // A mirror image stands beside what it is made of.
      claim_operands(*source);
    }
  }
}

void Reader::claim_operands(const Object& shown) {
  std::vector<const Object*> open = {&shown};
  while (!open.empty()) {
    const Object& object = *open.back();
    open.pop_back();
    for (const std::string_view name : operands_of(object)) {
      const Object* const operand = document_.find(name);
      if (operand != nullptr && operands_.insert(name).second) {
        open.push_back(operand);
      }
    }
  }
}

std::vector<const Object*> Reader::objects_of(const Object& group) {
  const std::vector<std::string_view> names = members_of(group);
  std::vector<const Object*> objects;
  std::vector<std::string_view> missing;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Object* const object = document_.find(names[i]);
    if (object == nullptr) {
      if (!names[i].empty()) missing.push_back(names[i]);
      continue;
    }
    // A group of links says itself which of them it shows.
    (is_listed_hidden(group, i) ? hidden_ : objects).push_back(object);
  }
  if (!missing.empty()) {
    model_.warnings.push_back(
        fmt::format("{} holds objects that the file lacks: '{}'", shown(group),
                    fmt::join(missing, "', '")));
  }
  // A part names the members of its plain groups, too.
  const std::set<const Object*> all(objects.begin(), objects.end());
  std::erase_if(objects, [&](const Object* object) {
    const std::vector<const Object*>& groups = groups_[object];
    return std::any_of(groups.begin(), groups.end(), [&](const Object* other) {
      return other != &group && other->is_visible() && all.contains(other);
    });
  });
  return objects;
}

void Reader::make_shown(const std::vector<const Object*>& objects,
                        std::vector<Solid>& solids) {
  for (const Object* const object : objects) {
    if (!is_part(*object)) continue;
    if (operands_.contains(object->name())) {
      if (object->is_visible() && !is_flat(*object)) used_.push_back(object);
      continue;
    }
    if (is_flat(*object)) {
      if (object->is_visible()) flat_.push_back(object);
      continue;
    }
    // Of a plain group that is hidden the members are shown that are visible.
    if (!object->is_visible() &&
        !object->has_extension("App::GroupExtension")) {
      hidden_.push_back(object);
      continue;
    }
    if (const Made solid = make(*object)) {
      solids.push_back(*solid);
    } else {
      report_left_out(*object);
    }
  }
}

void Reader::note_all(std::string_view what,
                      const std::vector<const Object*>& objects) {
  std::string names;
  for (const Object* const object : objects) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", shown(*object));
  }
  if (!names.empty())
    model_.notes.push_back(fmt::format("{}: {}", what, names));
}

void Reader::report_left_out(const Object& object) {
  const std::string& why = entries_[&object].why;
  if (is_group(object)) return;  // it holds nothing
  model_.warnings.push_back(
      fmt::format("{} is left out: {}", shown(object),
                  why.empty() ? "it stores no faces" : why));
}

// --- Making -----------------------------------------------------------------

Reader::Made Reader::make(std::string_view name) {
  const Object* const object = document_.find(name);
  return object == nullptr ? std::nullopt : make(*object);
}

Reader::Made Reader::make(const Object& object) {
  const auto [found, is_new] = entries_.try_emplace(&object);
  Entry& entry = found->second;
  if (is_new) {
    constexpr std::size_t kDeepest = 1000;
    if (state_.open.size() == kDeepest) {
      throw plane::LimitExceeded(fmt::format(
          "Too deep: {} objects are made of one another, at most {} can be",
          state_.open.size(), kDeepest));
    }
    state_.open.push_back(&object);
    entry.solid = make_anew(object, entry.why);
    state_.open.pop_back();
    entry.is_done = true;
  }
  if (!entry.is_done) fail_made_from_itself(object);
  return entry.solid;
}

Reader::Made Reader::make_anew(const Object& object, std::string& why) {
  if (const Make maker = maker_of(object)) {
    if (const Made solid = (this->*maker)(object, why)) return solid;
    if (is_group(object)) return std::nullopt;
  }
  return by_boundary(object, why);
}

Reader::Make Reader::maker_of(const Object& object) {
  static const std::map<std::string_view, Make> kMakers = {
      {"App::Part", &Reader::make_group},
      {"App::LinkGroup", &Reader::make_group},
      {"App::Link", &Reader::make_link},
      {"App::LinkElement", &Reader::make_link},
      {"Part::Cut", &Reader::make_boolean},
      {"Part::Fuse", &Reader::make_boolean},
      {"Part::Common", &Reader::make_boolean},
      {"Part::MultiFuse", &Reader::make_boolean},
      {"Part::MultiCommon", &Reader::make_boolean},
      {"Part::Compound", &Reader::make_boolean},
      {"Part::Mirroring", &Reader::make_mirroring},
      {"Part::Extrusion", &Reader::make_extrusion},
      {"Part::Revolution", &Reader::make_part_revolution},
      {"PartDesign::Body", &Reader::make_body},
      {"PartDesign::FeatureBase", &Reader::make_base},
      {"PartDesign::Boolean", &Reader::make_body_boolean},
      {"PartDesign::Pad", &Reader::make_feature},
      {"PartDesign::Pocket", &Reader::make_feature},
      {"PartDesign::Revolution", &Reader::make_feature},
      {"PartDesign::Groove", &Reader::make_feature}};
  const std::string_view type = object.type();
  const auto found = kMakers.find(type);
  if (found != kMakers.end()) return found->second;
  if (type.starts_with("App::DocumentObjectGroup")) return &Reader::make_group;
  const auto is_primitive_behind = [&](std::string_view prefix) {
    return type.starts_with(prefix) && is_primitive(type.substr(prefix.size()));
  };
  if (is_primitive_behind("Part::")) return &Reader::make_part_primitive;
  if (is_primitive_behind("PartDesign::Additive") ||
      is_primitive_behind("PartDesign::Subtractive")) {
    return &Reader::make_feature;
  }
  if (object.has_extension("App::LinkExtension")) return &Reader::make_link;
  // An assembly, say, or a storey, whose shape merely repeats its members'. A
  // layer of a drawing has a Group too, but is none.
  if (object.value("Group") && object.has_extension("GroupExtension") &&
      (!has_geometry(object) || type.starts_with("App::"))) {
    return &Reader::make_group;
  }
  return nullptr;
}

// Told to, of a wire: of a face there is a solid all the same.
bool Reader::makes_surface(const Object& object) const {
  return !object.flag("Solid") && !document_.has_stored_solid(object);
}

bool Reader::is_part(const Object& object) {
  return has_geometry(object) || maker_of(object) != nullptr;
}

bool Reader::is_group(const Object& object) {
  return maker_of(object) == &Reader::make_group;
}

bool Reader::is_binder(const Object& object) {
  return object.is_a("PartDesign::ShapeBinder") ||
         object.is_a("PartDesign::SubShapeBinder");
}

bool Reader::is_flat(const Object& object) const {
  return has_flat_type(object) ||
         (is_binder(object) && !document_.has_stored_solid(object));
}

Reader::Made Reader::by_boundary(const Object& object, const std::string& why) {
  if (is_flat(object)) return std::nullopt;
  const std::string_view stored = document_.boundary_entry(object);
  if (stored.empty()) return std::nullopt;
  if (object.value("Solid") && makes_surface(object)) return std::nullopt;
  model_.notes.push_back(fmt::format("{} is taken by its boundary{}{}",
                                     shown(object), why.empty() ? "" : ": ",
                                     why));
  const auto [found, is_new] = boundaries_.try_emplace(stored);
  if (is_new) {
    ImportParams params;
    params.path = path_;
    params.format = ImportFormat::kFcstd;
    params.entry = maker_.keep_text(stored);
    params.boundary = maker_.keep_text(document_.unpack(stored));
    params.csg_text =
        maker_.keep_text(state_.options.boundary_text(path_, object.name()));
    found->second = maker_.leaf(Import{maker_.keep(params)});
  }
  return found->second;
}

// --- Groups and links -------------------------------------------------------

Reader::Made Reader::make_group(const Object& object, std::string&) {
  std::vector<Solid> solids;
  make_shown(objects_of(object), solids);
  if (solids.empty()) return std::nullopt;
  const Solid all = maker_.unite(solids);
  // Members of plain groups stand where they would without them.
  if (object.has_extension("App::GroupExtension")) return all;
  return maker_.place(object.placement(), all);
}

// A link shows its target at a place of its own or, if it keeps the target's,
// in a frame of its own. Draft's arrays are links under other names.
Reader::Made Reader::make_link(const Object& object, std::string& why) {
  const char* const target_name =
      object.value("LinkedObject") ? "LinkedObject" : "Base";
  const Made target = make_target(object.object_link(target_name),
                                  object.flag("LinkTransform"), why);
  if (!target) return std::nullopt;
  const char* const own =
      object.value("Placement") ? "Placement" : "LinkPlacement";
  Mat4 scale(1);
  if (const auto factors = object.vector("ScaleVector")) {
    scale = scaling(*factors);
    if (factors->x == 0 || factors->y == 0 || factors->z == 0) {
      why = "its ScaleVector leaves no volume";
      return std::nullopt;
    }
  }
  const char* const count =
      object.value("ElementCount") ? "ElementCount" : "Count";
  const Made all = object.number(count, 0) > 0
                       ? make_link_array(object, *target, why)
                       : target;
  if (!all) return std::nullopt;
  return maker_.place(object.placement(own) * scale, *all);
}

Reader::Made Reader::make_target(const ObjectLink& link, bool keeps_place,
                                 std::string& why) {
  if (link.object.empty()) {
    why = "it links to nothing";
    return std::nullopt;
  }
  Reader* const reader = reader_of(link.file);
  if (reader == nullptr) {
    why = fmt::format("there is no file '{}' to link to", link.file);
    return std::nullopt;
  }
  const Object* const target = reader->document_.find(link.object);
  if (target == nullptr) {
    why = link.file.empty()
              ? fmt::format("there is no object '{}'", link.object)
              : fmt::format("'{}' has no object '{}'", link.file, link.object);
    return std::nullopt;
  }
  // Where the link keeps no place, that of its target is undone; on the way to
  // a part of the target it just does not count.
  const bool is_whole = link.path.empty();
  Mat4 frame(1);
  if (is_whole && !keeps_place) frame = glm::inverse(target->placement());
  if (!is_whole && keeps_place) frame = target->placement();
  const Object* const object =
      is_whole ? target : reader->follow(*target, link.path, frame, why);
  if (object == nullptr) return std::nullopt;
  const Made solid = reader->make(*object);
  if (!solid) {
    why = fmt::format("{} is no solid", shown(*object));
    return std::nullopt;
  }
  return maker_.place(frame, *solid);
}

const Object* Reader::follow(const Object& first, std::string_view path,
                             Mat4& frame, std::string& why) const {
  const Object* object = &first;
  for (;;) {
    const std::size_t dot = path.find('.');
    if (dot == path.npos) {
      why = fmt::format("it links to {} of {}", path, shown(*object));
      return nullptr;
    }
    // A dollar sign says that a label follows.
    const std::string_view name = path.substr(0, dot);
    const Object* const member = name.starts_with('$')
                                     ? document_.find_part(name.substr(1))
                                     : document_.find(name);
    const auto members = members_of(*object);
    if (member == nullptr || std::find(members.begin(), members.end(),
                                       member->name()) == members.end()) {
      why = fmt::format("it links to '{}' of {}", name, shown(*object));
      return nullptr;
    }
    path.remove_prefix(dot + 1);
    if (path.empty()) return member;
    if (!member->has_extension("App::GroupExtension")) {
      frame = frame * member->placement();
    }
    object = member;
  }
}

Reader* Reader::reader_of(std::string_view file) {
  if (file.empty()) return this;
  const FreecadOptions& options = state_.options;
  if (!options.find_linked) return nullptr;
  const std::string_view path = options.find_linked(path_, file);
  const auto [found, is_new] = state_.readers.try_emplace(path);
  if (!is_new) return found->second.get();
  auto bytes = options.read_linked(path);
  if (!bytes) return nullptr;
  const std::string& kept = state_.linked_bytes.emplace_back(*std::move(bytes));
  try {
    found->second = std::make_unique<Reader>(kept, path, state_);
  } catch (const FormatError& fault) {
    throw FormatError(
        fmt::format("{}, in '{}', which a link names", fault.what(), file));
  }
  return found->second.get();
}

// Elements are objects of their own, or stand in lists of the array.
Reader::Made Reader::make_link_array(const Object& object, const Solid& target,
                                     std::string& why) {
  std::vector<Solid> solids;
  if (!members_of(object).empty()) {
    for (const Object* const element : objects_of(object)) {
      if (const Made made = make(*element)) solids.push_back(*made);
    }
  } else {
    const std::vector<Mat4> places =
        document_.placements_of(object, "PlacementList");
    const std::vector<Vec3> scales = document_.vectors_of(object, "ScaleList");
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (is_listed_hidden(object, i)) continue;
      const Mat4 scale = i < scales.size() ? scaling(scales[i]) : Mat4(1);
      solids.push_back(maker_.place(places[i] * scale, target));
    }
  }
  if (solids.empty()) {
    why = "none of its elements is shown";
    return std::nullopt;
  }
  return maker_.unite(solids);
}

}  // namespace lamina::csg::freecad

namespace lamina::csg {

std::vector<FreecadPart> freecad_parts(std::string_view bytes) {
  Arena arena;
  const FreecadOptions options;
  freecad::ImportState state(options, arena);
  return freecad::Reader(bytes, {}, state).parts();
}

FreecadModel read_freecad(std::string_view bytes, const FreecadOptions& options,
                          Arena& arena) {
  freecad::ImportState state(options, arena);
  auto& reader = state.readers[options.path];
  reader = std::make_unique<freecad::Reader>(bytes, options.path, state);
  reader->read();
  return std::move(state.model);
}

}  // namespace lamina::csg
