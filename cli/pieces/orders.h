#pragma once
// Orders for plates: a CSV file with a row for each.
//
//     name,design,quantity,material,size
//     Ada,ring.scad,2,bluecast-x10,54
//
// All columns but the first four are variables of the row's design. `design`,
// `quantity` and `material` may be missing, or cells of them empty: then the
// command line decides, and one piece is made.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "base/source.h"
#include "compiler/request.h"

namespace lamina::cli {

// Where orders come from: a table, or so many copies of each design.
struct OrderSources {
  std::vector<std::string> designs;
  std::string table;  // path; empty: none
  std::optional<unsigned> copies;
};

// Throws RequestError where they do not go together.
void check(const OrderSources& sources, std::string_view command);

struct Order {
  std::string name;
  compiler::Request request;
  std::size_t quantity = 1;
};

// What is wrong with the table is an error in `diagnostics`.
//
// request  of all orders; its design is that of rows that name none
// throws   Error where the table or a design cannot be read
std::vector<Order> read_orders(const OrderSources& from,
                               const compiler::Request& request,
                               const FileAccess& access, SourceStore& sources,
                               Diagnostics& diagnostics);

}  // namespace lamina::cli
