#!/bin/sh
# isolate.sh IN.a OUT.a PREFIX [TOOLS]: a static library whose only visible symbols begin with
# PREFIX_.
#
# The library of Rust has functions of its own (memcpy, the panic handler, a standard library on a
# computer), which the library of another robot has, too. Here one object takes what the functions
# of PREFIX need, and all other symbols become local. TOOLS is the prefix of the binary utilities,
# such as arm-none-eabi-.
set -eu
in=$1 out=$2 prefix=$3 tools=${4-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${tools}nm" --defined-only --extern-only "$in" 2>/dev/null | awk -v head="${prefix}_" \
	'index($3, head) == 1 && $2 == "T" { print $3 }' | sort -u > "$work/keep"
test -s "$work/keep" || { echo "isolate.sh: $in has no function ${prefix}_*" >&2; exit 1; }
"${tools}ld" -r --force-group-allocation $(sed 's/^/-u /' "$work/keep") "$in" -o "$work/$prefix.o"
# The bitcode of Rust's core library would make the archiver's LLVM plugin fail.
"${tools}objcopy" --keep-global-symbols="$work/keep" --remove-section=.llvmbc --remove-section=.llvmcmd \
	"$work/$prefix.o"
rm -f "$out.new"
"${tools}ar" crsD "$out.new" "$work/$prefix.o"
mv "$out.new" "$out"
