# What a release does against mistakes of its own that a hostile design could
# use: it leaves little to aim at.
add_library(lamina_hardening INTERFACE)

# Programs lie at random addresses; modules do in any case. No memory is both
# written and run, and the loader's tables are read-only before main().
set(is_program $<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>)
target_link_options(lamina_hardening INTERFACE
  $<${is_program}:-pie>
  -Wl,-z,relro,-z,now,-z,noexecstack,-z,separate-code)
