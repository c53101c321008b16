/* What the example needs of a board: text, a counter, an end. */
#ifndef BOARD_H
#define BOARD_H

#include <stdint.h>

/* Prints text to the debugger or QEMU. */
void print(const char *text);
/* Prints an integer. */
void print_integer(int32_t value);
/* Prints a number with six decimals. */
void print_float(float value);
/* Prints the bits of a number in hexadecimal. */
void print_bits(float value);
/* Counts at 168 MHz, modulo 2^24. */
uint32_t counts(void);
/* Ends QEMU. */
_Noreturn void leave(int good);

/* Markers for `cargo xtask meter ELF` of dynamics-core's repository: a region k from BEGIN(k) to END(k). */
#ifdef __arm__
#define BEGIN(k) __asm volatile("dbg %0" ::"i"(2 * (k)) : "memory")
#define END(k) __asm volatile("dbg %0" ::"i"(2 * (k) + 1) : "memory")
#else
#define BEGIN(k)
#define END(k)
#endif

#endif
