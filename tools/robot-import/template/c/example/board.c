/* Start-up, semihosting and SysTick of a Cortex-M4F without a C library. */
#include "board.h"

#include <stddef.h>

extern uint32_t stack_top, data_start, data_end, data_load, bss_start, bss_end;
int main(void);

/* GCC calls these for whole objects, also without a C library. The volatile keeps them from calling themselves. */
void *memcpy(void *to, const void *from, size_t bytes)
{
    for (size_t at = 0; at < bytes; at++) {
        ((volatile unsigned char *)to)[at] = ((const unsigned char *)from)[at];
    }
    return to;
}

void *memset(void *to, int value, size_t bytes)
{
    for (size_t at = 0; at < bytes; at++) {
        ((volatile unsigned char *)to)[at] = (unsigned char)value;
    }
    return to;
}

static void enable_fpu(void)
{
    *(volatile uint32_t *)0xE000ED88 |= 0xFu << 20; /* CPACR: full access to CP10 and CP11 */
    __asm volatile("dsb\n\tisb" ::: "memory");
}

static void start_counter(void)
{
    volatile uint32_t *systick = (volatile uint32_t *)0xE000E010;
    systick[1] = 0x00FFFFFF;
    systick[2] = 0;
    systick[0] = 5; /* the processor's clock, no interrupt */
}

_Noreturn void reset(void)
{
    enable_fpu();
    const uint32_t *from = &data_load;
    for (uint32_t *to = &data_start; to < &data_end;) {
        *to++ = *from++;
    }
    for (uint32_t *to = &bss_start; to < &bss_end;) {
        *to++ = 0;
    }
    start_counter();
    leave(main() == 0);
}

static _Noreturn void fault(void)
{
    print("error: a fault of the processor\n");
    leave(0);
}

__attribute__((section(".vectors"), used)) static void *const vectors[16] = {
    &stack_top, (void *)reset, (void *)fault, (void *)fault, (void *)fault, (void *)fault, (void *)fault,
};

static int semihost(int operation, const void *argument)
{
    register int r0 __asm("r0") = operation;
    register const void *r1 __asm("r1") = argument;
    __asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

void print(const char *text)
{
    static int output;
    if (output == 0) {
        const uintptr_t console[3] = {(uintptr_t) ":tt", 4, 3}; /* to be written: standard output */
        output = semihost(0x01, console);                      /* SYS_OPEN */
    }
    uintptr_t length = 0;
    while (text[length] != 0) {
        length++;
    }
    const uintptr_t block[3] = {(uintptr_t)output, (uintptr_t)text, length};
    semihost(0x05, block); /* SYS_WRITE */
}

_Noreturn void leave(int good)
{
    for (;;) {
        /* SYS_EXIT: ADP_Stopped_ApplicationExit, or ADP_Stopped_RunTimeErrorUnknown */
        semihost(0x18, (const void *)(uintptr_t)(good ? 0x20026 : 0x20023));
    }
}

uint32_t counts(void)
{
    return 0x00FFFFFF - *(volatile uint32_t *)0xE000E018;
}

static void print_unsigned(uint32_t value, uint32_t base, int digits)
{
    char text[12];
    int at = 11;
    text[at] = 0;
    while (at > 0 && (value != 0 || digits > 0)) {
        text[--at] = "0123456789abcdef"[value % base];
        value /= base;
        digits--;
    }
    print(text + at);
}

void print_integer(int32_t value)
{
    if (value < 0) {
        print("-");
    }
    print_unsigned(value < 0 ? 0u - (uint32_t)value : (uint32_t)value, 10, 1);
}

void print_bits(float value)
{
    union {
        float number;
        uint32_t bits;
    } both = {value};
    print_unsigned(both.bits, 16, 8);
}

void print_float(float value)
{
    if (!(value > -4e9f && value < 4e9f)) {
        print("beyond 4e9");
        return;
    }
    print(value < 0 ? "-" : "");
    float size = value < 0 ? -value : value;
    uint32_t whole = (uint32_t)size;
    uint32_t millionths = (uint32_t)((size - (float)whole) * 1e6f + 0.5f);
    print_unsigned(whole + millionths / 1000000, 10, 1);
    print(".");
    print_unsigned(millionths % 1000000, 10, 6);
}
