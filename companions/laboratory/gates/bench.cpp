// The memory of the core, what a program prints, and how it ends.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "Vcv32e40p_top.h"
#include "verilated.h"

namespace {
constexpr uint32_t BASE = 0x80000000, SIZE = 4u << 20, HOST = 0x40000000;
std::vector<uint8_t> memory(SIZE);
uint32_t call[3];

[[noreturn]] void fail(const char* what, uint32_t at) {
  std::fflush(stdout);
  std::fprintf(stderr, "%s at 0x%08x\n", what, at);
  std::exit(1);
}

uint32_t word(uint32_t address) {
  uint32_t value = 0;
  if (address - BASE <= SIZE - 4) std::memcpy(&value, &memory[address - BASE], 4);
  return value;
}

uint32_t text(uint32_t address, uint32_t length) {
  if (address - BASE > SIZE || length > SIZE - (address - BASE))
    fail("a text outside of the memory", address);
  std::fwrite(&memory[address - BASE], 1, length, stdout);
  return 0;
}

uint32_t semihosting(uint32_t operation, uint32_t block) {
  switch (operation) {
    case 0x01: return 1;                                        // SYS_OPEN
    case 0x02: return 0;                                        // SYS_CLOSE
    case 0x05: return text(word(block + 4), word(block + 8));   // SYS_WRITE
    case 0x18:                                                  // SYS_EXIT
    case 0x20: std::fflush(stdout); std::exit(word(block + 4)); // SYS_EXIT_EXTENDED
    default: fail("an unknown call of semihosting", operation);
  }
}

void load(const char* path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<uint8_t> elf((std::istreambuf_iterator<char>(file)), {});
  auto half = [&](size_t at) { return elf.at(at) | elf.at(at + 1) << 8; };
  auto full = [&](size_t at) { return uint32_t(half(at)) | uint32_t(half(at + 2)) << 16; };
  for (int i = 0; i < half(44); i++) {
    size_t header = full(28) + size_t(i) * half(42);
    if (full(header) != 1) continue;
    uint32_t offset = full(header + 4), to = full(header + 12), length = full(header + 16);
    if (length == 0) continue;
    if (length > SIZE || to - BASE > SIZE - length || size_t(offset) + length > elf.size())
      fail("a segment outside of the memory", to);
    std::memcpy(&memory[to - BASE], &elf[offset], length);
  }
}
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  load(argv[1]);
  const uint64_t limit = std::strtoull(argv[2], nullptr, 10);
  Vcv32e40p_top core;
  core.boot_addr_i = BASE;
  core.mtvec_addr_i = BASE;
  core.instr_gnt_i = core.data_gnt_i = 1;
  core.fetch_enable_i = 1;
  for (uint64_t cycle = 0; cycle < limit; cycle++) {
    // Registers behind a clock gate are reset by the fall of this signal alone.
    core.rst_ni = cycle < 2 || cycle >= 8;
    core.clk_i = 0;
    core.eval();
    const bool fetches = core.instr_req_o, accesses = core.data_req_o, writes = core.data_we_o;
    const uint32_t fetched = core.instr_addr_o, at = core.data_addr_o & ~3u;
    const uint32_t bytes = core.data_be_o, value = core.data_wdata_o;
    core.clk_i = 1;
    core.eval();
    core.instr_rvalid_i = fetches && core.rst_ni;
    core.instr_rdata_i = word(fetched);
    core.data_rvalid_i = accesses && core.rst_ni;
    if (!accesses || !core.rst_ni) continue;
    if (at - HOST < 12) {
      uint32_t& cell = call[(at - HOST) / 4];
      if (writes) cell = value;
      core.data_rdata_i = writes ? 0 : semihosting(call[0], call[1]);
    } else if (at - BASE > SIZE - 4) {
      fail("an access outside of the memory", at);
    } else if (writes) {
      for (int i = 0; i < 4; i++)
        if (bytes >> i & 1) memory[at - BASE + i] = value >> 8 * i;
    } else {
      core.data_rdata_i = word(at);
    }
  }
  fail("the program did not end", 0);
}
