/* What the example needs of a board, on a computer. */
#include "board.h"

#include <stdio.h>
#include <stdlib.h>

void print(const char *text)
{
    fputs(text, stdout);
}

void print_integer(int32_t value)
{
    printf("%ld", (long)value);
}

void print_bits(float value)
{
    union {
        float number;
        uint32_t bits;
    } both = {value};
    printf("%08lx", (unsigned long)both.bits);
}

void print_float(float value)
{
    printf("%.6f", (double)value);
}

/* Nothing counts instructions here. */
uint32_t counts(void)
{
    return 0;
}

_Noreturn void leave(int good)
{
    exit(good ? EXIT_SUCCESS : EXIT_FAILURE);
}
