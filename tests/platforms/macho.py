"""A library for macOS in an emulator of its processor: macho.py PROCESSOR LIBRARY GUID INPUT OUTPUT... < HISTORY

It does what host.c does and prints the same. PROCESSOR is x86_64 or arm64, and must be in the library. This is no macOS: the code runs in an emulator, and what it takes from the system comes from
this program. Before, everything is checked that a Mac looks at when it loads a library and that can be seen in the file.
"""

import hashlib
import struct
import sys

import lief
from unicorn import UC_ARCH_ARM64, UC_ARCH_X86, UC_HOOK_CODE, UC_MODE_64, UC_MODE_ARM, Uc
from unicorn import arm64_const as arm
from unicorn import x86_const as x86

FUNCTIONS = 44
OLDEST = {"x86_64": (10, 12), "arm64": (11, 0)}
CODE_DIRECTORY, ADHOC, SHA256 = 0xFADE0C02, 0x2, 2
LOG_ARGUMENTS = 5


def slice_of(path, processor):
    """The bytes of the part of a library that is for `processor`."""
    with open(path, "rb") as file:
        whole = file.read()
    wanted = {"x86_64": 0x01000007, "arm64": 0x0100000C}[processor]
    if whole[:4] != b"\xca\xfe\xba\xbe":
        assert struct.unpack_from("<I", whole, 4)[0] == wanted, f"no library for {processor}"
        return whole
    (count,) = struct.unpack_from(">I", whole, 4)
    for place in range(count):
        kind, _, start, size, alignment = struct.unpack_from(">5I", whole, 8 + 20 * place)
        if kind == wanted:
            assert start % (1 << alignment) == 0, "a part that isn't aligned"
            return whole[start : start + size]
    raise AssertionError(f"no part for {processor}")


def check_signature(library, start):
    """The hash of each page in the signature at `start`."""
    magic, _, count = struct.unpack_from(">III", library, start)
    assert magic == 0xFADE0CC0, "no signature"
    places = [struct.unpack_from(">II", library, start + 12 + 8 * place)[1] + start for place in range(count)]
    (directory,) = [place for place in places if struct.unpack_from(">I", library, place)[0] == CODE_DIRECTORY]
    _, _, _, flags, hashes, _, _, pages, limit = struct.unpack_from(">9I", library, directory)
    size, kind, _, page = struct.unpack_from(">4B", library, directory + 36)
    assert (size, kind, limit) == (32, SHA256, start) and flags & ADHOC, "a signature of another kind"
    assert pages == -(-limit >> page), "pages without a hash"
    for number in range(pages):
        place = directory + hashes + size * number
        bytes_of_page = library[number << page : min((number + 1) << page, limit)]
        assert hashlib.sha256(bytes_of_page).digest() == library[place : place + size], f"page {number} was changed"


def check(library, parsed, processor):
    """What a Mac looks at before it runs anything."""
    kinds = lief.MachO.LoadCommand.TYPE
    own = [command.name for command in parsed.libraries if command.command == kinds.ID_DYLIB]
    needed = [command.name for command in parsed.libraries if command.command != kinds.ID_DYLIB]
    oldest = parsed.build_version.minos if parsed.has_build_version else parsed.version_min.version
    assert [name.startswith("@rpath/") for name in own] == [True], own
    assert needed == ["/usr/lib/libSystem.B.dylib"], needed
    assert tuple(oldest[:2]) == OLDEST[processor], oldest
    for segment in parsed.segments:
        assert segment.init_protection != 7 and segment.max_protection != 7, "memory that can be written and executed"
        assert segment.virtual_address % 0x1000 == 0 and segment.file_offset % 0x1000 == 0, segment.name
    exports = [symbol.name for symbol in parsed.exported_symbols]
    assert len(set(exports)) == FUNCTIONS and all(name.startswith("_fmi2") for name in exports), exports
    assert parsed.has_code_signature, "not signed"
    check_signature(library, parsed.code_signature.data_offset)


class Machine:
    """The library in memory, and what it finds there."""

    STUBS, HEAP, STACK, END, SLIDE = 0x7000000000, 0x6000000000, 0x5000000000, 0x7000F00000, 0x100000000
    HEAP_SIZE, STACK_SIZE = 0x4000000, 0x400000

    def __init__(self, path, processor):
        library = slice_of(path, processor)
        self.fat = lief.MachO.parse(list(library))
        self.parsed = self.fat.at(0)
        check(library, self.parsed, processor)
        self.is_arm = processor == "arm64"
        self.uc = Uc(UC_ARCH_ARM64, UC_MODE_ARM) if self.is_arm else Uc(UC_ARCH_X86, UC_MODE_64)
        for place, size in ((self.STUBS, 0x1000000), (self.HEAP, self.HEAP_SIZE), (self.STACK, self.STACK_SIZE)):
            self.uc.mem_map(place, size)
        self.place_segments(library)
        self.bind()
        self.top, self.free, self.taken, self.given_back, self.message = self.HEAP + 16, {}, 0, 0, ""
        self.callbacks = {self.STUBS + 0x800000 + 16 * place: name for place, name in enumerate(("log", "take", "give"))}
        self.uc.hook_add(UC_HOOK_CODE, self.serve, begin=self.STUBS, end=self.STUBS + 0xEFFFFF)
        self.addresses = {symbol.name: self.SLIDE + symbol.value for symbol in self.parsed.exported_symbols}
        if self.is_arm:
            self.uc.reg_write(arm.UC_ARM64_REG_CPACR_EL1, 3 << 20)
            self.integers = [getattr(arm, f"UC_ARM64_REG_X{place}") for place in range(8)]
        else:
            names = ("RDI", "RSI", "RDX", "RCX", "R8", "R9")
            self.integers = [getattr(x86, f"UC_X86_REG_{name}") for name in names]

    def place_segments(self, library):
        segments = self.parsed.segments
        low = min(segment.virtual_address for segment in segments)
        high = max(segment.virtual_address + segment.virtual_size for segment in segments)
        self.uc.mem_map(self.SLIDE + (low & ~0xFFFF), (high - low + 0x1FFFF) & ~0xFFFF)
        for segment in segments:
            content = library[segment.file_offset : segment.file_offset + segment.file_size]
            self.uc.mem_write(self.SLIDE + segment.virtual_address, content)
        for segment in segments:
            for relocation in segment.relocations:
                place = self.SLIDE + relocation.address
                (value,) = self.read("<Q", place)
                self.uc.mem_write(place, struct.pack("<Q", value + self.SLIDE))

    def bind(self):
        self.names, places = {}, {}
        for binding in self.parsed.bindings:
            name = binding.symbol.name
            place = places.setdefault(name, self.STUBS + 16 * (len(places) + 1))
            self.names[place] = name
            self.uc.mem_write(self.SLIDE + binding.address, struct.pack("<Q", place))

    def read(self, form, place):
        return struct.unpack(form, bytes(self.uc.mem_read(place, struct.calcsize(form))))

    def text(self, place):
        end = place
        while self.uc.mem_read(end, 1) != b"\0":
            end += 1
        return bytes(self.uc.mem_read(place, end - place))

    def allocate(self, size):
        place = self.top
        self.top += (size + 31) & ~15
        assert self.top < self.HEAP + self.HEAP_SIZE, "no memory left"
        self.uc.mem_write(place, b"\0" * size)
        return place

    def put(self, content):
        place = self.allocate(len(content))
        self.uc.mem_write(place, content)
        return place

    def argument(self, place):
        return self.uc.reg_read(self.integers[place])

    def serve(self, _uc, place, _size, _data):
        """What the library calls."""
        name, result = self.names.get(place) or self.callbacks[place], 0
        first, second, third = (self.argument(number) for number in range(3))
        if name in ("_calloc", "take"):
            self.taken += name == "take"
            result = self.allocate(first * second)
        elif name in ("_free", "give"):
            self.given_back += name == "give"
        elif name in ("_memcpy", "_memmove"):
            self.uc.mem_write(first, bytes(self.uc.mem_read(second, third)))
            result = first
        elif name in ("_memset", "_bzero", "___bzero"):
            byte, count = (second & 255, third) if name == "_memset" else (0, second)
            self.uc.mem_write(first, bytes([byte]) * count)
            result = first
        elif name == "_memset_pattern16":
            pattern = bytes(self.uc.mem_read(second, 16))
            self.uc.mem_write(first, (pattern * (third // 16 + 1))[:third])
        elif name in ("_memcmp", "_bcmp"):
            one, other = (bytes(self.uc.mem_read(place, third)) for place in (first, second))
            result = ((one > other) - (one < other)) & 0xFFFFFFFF
        elif name == "_strlen":
            result = len(self.text(first))
        elif name == "log":
            # whatever follows the text: it is complete, with each % doubled
            texts = [self.text(self.argument(number)).decode() for number in (1, 3, 4)]
            self.message = f"{texts[0]} {third & 0xFFFFFFFF} {texts[1]} {texts[2].replace('%%', '%')}"
        else:
            raise RuntimeError(f"{name} is not served")
        self.give(result)

    def give(self, result):
        """Returns to the library."""
        if self.is_arm:
            self.uc.reg_write(arm.UC_ARM64_REG_X0, result)
            self.uc.reg_write(arm.UC_ARM64_REG_PC, self.uc.reg_read(arm.UC_ARM64_REG_X30))
        else:
            stack = self.uc.reg_read(x86.UC_X86_REG_RSP)
            self.uc.reg_write(x86.UC_X86_REG_RAX, result)
            self.uc.reg_write(x86.UC_X86_REG_RSP, stack + 8)
            self.uc.reg_write(x86.UC_X86_REG_RIP, self.read("<Q", stack)[0])

    def call(self, name, *arguments):
        """Integers and pointers, and Python's floats as numbers."""
        numbers = [argument for argument in arguments if isinstance(argument, float)]
        integers = [argument for argument in arguments if not isinstance(argument, float)]
        for place, number in enumerate(numbers):
            (bits,) = struct.unpack("<Q", struct.pack("<d", number))
            self.uc.reg_write((arm.UC_ARM64_REG_D0 if self.is_arm else x86.UC_X86_REG_XMM0) + place, bits)
        for register, value in zip(self.integers, integers, strict=False):
            self.uc.reg_write(register, value)
        rest = integers[len(self.integers) :]
        stack = self.STACK + self.STACK_SIZE - 0x10000
        if self.is_arm:
            assert not rest
            self.uc.reg_write(arm.UC_ARM64_REG_SP, stack)
            self.uc.reg_write(arm.UC_ARM64_REG_X30, self.END)
        else:
            # as a call leaves it: 8 bytes off a multiple of 16
            self.uc.mem_write(stack - 8, struct.pack(f"<{1 + len(rest)}Q", self.END, *rest))
            self.uc.reg_write(x86.UC_X86_REG_RSP, stack - 8)
        self.uc.emu_start(self.addresses["_" + name], self.END)
        return self.uc.reg_read(arm.UC_ARM64_REG_X0 if self.is_arm else x86.UC_X86_REG_RAX)

    def succeed(self, name, *arguments):
        status = self.call(name, *arguments) & 0xFFFFFFFF
        assert status == 0, f"{name}: {status} {self.message}"


def go(machine, component, interface, steps, first):
    """The outputs after each step from step `first` on, as bits."""
    given, outputs, references, count, values = interface
    rows, time = [], 0.0
    for number, (rate, size) in enumerate(steps):
        if number >= first:
            machine.uc.mem_write(values, struct.pack("<d", rate))
            machine.succeed("fmi2SetReal", component, given, 1, values)
            machine.succeed("fmi2DoStep", component, 1, time, size)
            machine.succeed("fmi2GetReal", component, references, count, outputs)
            rows.append(machine.read(f"<{count}Q", outputs))
        time += size
    return rows


def run_unit(machine, guid, references, steps):
    texts = [machine.put(text) for text in (b"host\0", guid.encode() + b"\0", b"\0")]
    assert machine.text(machine.call("fmi2GetVersion")) == b"2.0"
    assert machine.text(machine.call("fmi2GetTypesPlatform")) == b"default"
    callbacks = machine.put(struct.pack("<5Q", *machine.callbacks, 0, 0))
    component = machine.call("fmi2Instantiate", texts[0], 1, texts[1], texts[2], callbacks, 0, 1)
    assert component, machine.message
    machine.succeed("fmi2SetupExperiment", component, 0, 0, 0.0, 0.0, 0.0)
    machine.succeed("fmi2EnterInitializationMode", component)
    machine.succeed("fmi2ExitInitializationMode", component)
    count, middle = len(references) - 1, len(steps) // 2
    pointers = [machine.put(struct.pack("<I", references[0])), machine.allocate(8 * count)]
    pointers += [machine.put(struct.pack(f"<{count}I", *references[1:])), count, machine.allocate(8)]
    rows = go(machine, component, pointers, steps[:middle], 0)
    state, copy, length = (machine.allocate(8) for _ in range(3))
    machine.succeed("fmi2GetFMUstate", component, state)
    machine.succeed("fmi2SerializedFMUstateSize", component, machine.read("<Q", state)[0], length)
    (size,) = machine.read("<Q", length)
    rest = go(machine, component, pointers, steps, middle)
    saved = machine.allocate(size)
    machine.succeed("fmi2SerializeFMUstate", component, machine.read("<Q", state)[0], saved, size)
    machine.succeed("fmi2DeSerializeFMUstate", component, saved, size, copy)
    machine.succeed("fmi2SetFMUstate", component, machine.read("<Q", copy)[0])
    assert go(machine, component, pointers, steps, middle) == rest, "other bits after restoring"
    for pointer in (state, copy):
        machine.succeed("fmi2FreeFMUstate", component, pointer)
    for row in rows + rest:
        print(" ".join(f"{bits:016x}" for bits in row))
    unknown = machine.put(struct.pack("<I", 1000000))
    assert machine.call("fmi2GetReal", component, unknown, 1, pointers[4]) & 0xFFFFFFFF == 3
    machine.call("fmi2FreeInstance", component)


def main():
    processor, path, guid = sys.argv[1:4]
    machine = Machine(path, processor)
    lines = [line.split() for line in sys.stdin]
    steps = [tuple(struct.unpack(">d", bytes.fromhex(word))[0] for word in line) for line in lines]
    run_unit(machine, guid, [int(reference) for reference in sys.argv[4:]], steps)
    print(f"end\nan emulator of macOS on {processor}\nmemory {machine.taken} {machine.given_back}\n{machine.message}")


if __name__ == "__main__":
    main()
