# What a release does against mistakes of its own that a hostile design could
# use: it ends where memory would be misused, and leaves little to aim at.
# Debian's packages are built by the same flags. Debug builds and sanitizers do
# without: these judge such mistakes better if nothing stands between.
#
# Left out: -fcf-protection, which Debian 12 never turns on (neither its loader
# nor the archives that are linked in know it) and which costs 0.5 to 0.9 %
# instructions.
add_library(lamina_hardening INTERFACE)

set(hardening
  # Overruns of the C library's functions, where the size is known at run time.
  -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3
  # Return addresses; jumps of the stack over its guard page.
  -fstack-protector-strong -fstack-clash-protection)
target_compile_options(lamina_hardening INTERFACE
  "$<$<CONFIG:Release>:${hardening}>")

# Ranges and emptiness in the C++ library's containers: where bytes of strangers
# are read. In all code it costs 10 to 20 % of the instructions.
set(LAMINA_CHECKED_CONTAINERS $<$<CONFIG:Release>:_GLIBCXX_ASSERTIONS>)

# Programs lie at random addresses; modules do in any case. No memory is both
# written and run, and the loader's tables are read-only before main().
set(is_program $<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>)
target_link_options(lamina_hardening INTERFACE
  $<${is_program}:-pie>
  -Wl,-z,relro,-z,now,-z,noexecstack,-z,separate-code)
