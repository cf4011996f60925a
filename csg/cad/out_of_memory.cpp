// OpenCASCADE's exception for the end of memory, which its libraries look for
// here first.
//
// Much of its code catches this exception and forgets it, so that a part of a
// shape is left. Here it is not even thrown: whoever makes one calls the
// handler of operator new, which ends the process (base/child_process.h).

#include <new>

// Not hidden, so that its libraries see what is defined below.
#pragma GCC visibility push(default)
#include <Standard_OutOfMemory.hxx>
#pragma GCC visibility pop

// The one without a message OpenCASCADE makes ahead, when it is loaded.
Standard_OutOfMemory::Standard_OutOfMemory(const Standard_CString message) {
  Standard_OutOfMemory::SetMessageString(message);
  const std::new_handler handler = std::get_new_handler();
  if (message != nullptr && handler != nullptr) handler();
}
