function part_size() = import("ring.json").size;
part_name = import("ring.json").name;
