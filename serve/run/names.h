#pragma once
// What a stranger may name: nothing else of a request reaches the file system.

#include <map>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "compiler/request.h"

namespace lamina::serve {

// A request that asks for what there is not.
struct NameError : Error {
  using Error::Error;
};

struct Names {
  std::vector<std::string> designs;
  std::vector<std::string> printers;
  std::vector<std::string> materials;
  std::vector<std::string> metals;
  std::vector<std::string> formats;  // extensions
  // Lamina's own names of materials and metals, by their other names.
  std::map<std::string, std::string> own_names;

  // The own name that another one means; else the name itself.
  const std::string& own_name(const std::string& name) const;
};

// The names that lamina knows, and those that `request` has: profiles, too.
Names known_names(const compiler::Request& request,
                  std::vector<std::string> designs);

// The request with lamina's own names of its printer, material and metal, where
// they are not profiles. Throws FileError where there are none such.
compiler::Request with_known_names(compiler::Request request,
                                   const FileAccess& access);

// Throws NameError for a name that is neither empty nor among the names.
//
// what  it names: "printer"
void require_name(const std::vector<std::string>& names,
                  const std::string& name, const char* what);

}  // namespace lamina::serve
