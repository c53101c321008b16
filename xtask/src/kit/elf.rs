//! The contents of an ELF: sizes, functions, and the places of Thumb code.

use std::collections::BTreeSet;
use std::ops::Range;
use std::path::Path;

use object::{Architecture, Object, ObjectSection, ObjectSymbol, SectionKind, SymbolKind};

use crate::kit::error::{Error, Result, check};

/// The first address of RAM on a Cortex-M.
const RAM: u64 = 0x2000_0000;

/// Bytes of the memories that an image takes.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
    /// Code, constants and the initial values of variables.
    pub flash: u64,
    /// Variables, without the stack.
    pub ram: u64,
}

#[derive(Clone, Debug)]
pub struct Function {
    /// All its names: identical functions are folded into one.
    pub names: Vec<String>,
    /// The address of its first instruction.
    pub address: u64,
    /// Its instructions and literal pools.
    pub bytes: Vec<u8>,
    /// The addresses at which data begins (`true`) or code goes on (`false`).
    pub data: Vec<(u64, bool)>,
}

pub struct Image {
    /// Whether it is for a 32-bit ARM processor.
    pub is_arm: bool,
    /// Whether what it logs are defmt's frames.
    pub has_defmt: bool,
    pub sizes: Sizes,
    pub functions: Vec<Function>,
    /// Every aligned word of its code and constants.
    pub words: BTreeSet<u32>,
    /// The addresses of the code that start-up copies into memory that never waits.
    pub fast: Range<u64>,
}

impl Function {
    /// A function of these halfwords, for tests.
    pub fn of(name: &str, address: u64, code: &[u16]) -> Self {
        Self {
            names: vec![name.into()],
            address,
            bytes: code.iter().flat_map(|half| half.to_le_bytes()).collect(),
            data: Vec::new(),
        }
    }
}

impl Image {
    /// An image of these functions for a Cortex-M, for tests.
    pub fn of(functions: Vec<Function>) -> Self {
        Self {
            is_arm: true,
            has_defmt: false,
            sizes: Sizes { flash: 0, ram: 0 },
            functions,
            words: BTreeSet::new(),
            fast: 0..0,
        }
    }
}

impl Image {
    pub fn read(path: &Path) -> Result<Self> {
        let bytes = std::fs::read(path).map_err(Error::file("read", path))?;
        let file = object::File::parse(&*bytes).map_err(|e| check!("{}: {e}", path.display()))?;
        Ok(Self {
            is_arm: file.architecture() == Architecture::Arm,
            has_defmt: file.section_by_name(".defmt").is_some(),
            sizes: sizes(&file),
            functions: functions(&file),
            words: words(&file),
            fast: file
                .section_by_name(".fast_text")
                .map_or(0..0, |section| section.address()..section.address() + section.size()),
        })
    }
}

/// The part of a section that lies in flash: initial values do, and are copied to RAM at start-up.
/// Constants that the linker has merged are in sections of strings.
fn is_in_flash(section: &object::Section<'_, '_>) -> bool {
    use SectionKind::{Data, ReadOnlyData, ReadOnlyString, Text};
    matches!(section.kind(), Text | ReadOnlyData | ReadOnlyString | Data)
}

fn sizes(file: &object::File<'_>) -> Sizes {
    let sum = |counts: &dyn Fn(&object::Section<'_, '_>) -> bool| {
        let counted = file.sections().filter(|section| counts(section));
        counted.map(|section| section.size()).sum()
    };
    Sizes {
        flash: sum(&is_in_flash),
        ram: sum(&|section| match section.kind() {
            SectionKind::Data => section.address() >= RAM,
            kind => kind == SectionKind::UninitializedData,
        }),
    }
}

fn words(file: &object::File<'_>) -> BTreeSet<u32> {
    let sections = file.sections().filter(is_in_flash);
    let data = sections.filter_map(|section| section.data().ok());
    let words = data.flat_map(|data| data.as_chunks().0.iter().copied());
    words.map(u32::from_le_bytes).collect()
}

fn functions(file: &object::File<'_>) -> Vec<Function> {
    // The ARM ABI marks where code and literal pools begin by symbols `$t` and `$d`.
    let mark = |symbol: object::Symbol<'_, '_>| match symbol.name().ok()?.get(..2)? {
        "$t" => Some((symbol.address(), false)),
        "$d" => Some((symbol.address(), true)),
        _ => None,
    };
    let mut marks: Vec<(u64, bool)> = file.symbols().filter_map(mark).collect();
    marks.sort_unstable();
    let code = file.symbols().filter(|symbol| symbol.kind() == SymbolKind::Text);
    let mut symbols: Vec<_> = code.filter(|symbol| symbol.size() > 0).collect();
    symbols.sort_by_key(ObjectSymbol::address);
    let mut functions: Vec<Function> = Vec::new();
    for symbol in symbols {
        // The lowest bit says Thumb and is no part of the address.
        let address = symbol.address() & !1;
        let name = symbol.name().unwrap_or_default().to_owned();
        if let Some(last) = functions.last_mut().filter(|last| last.address == address) {
            last.names.push(name);
            continue;
        }
        let section = symbol.section_index();
        let section = section.and_then(|at| file.section_by_index(at).ok());
        let bytes = section.and_then(|section| section.data_range(address, symbol.size()).ok()?);
        let mut function = Function {
            names: vec![name],
            address,
            bytes: bytes.unwrap_or_default().to_vec(),
            data: Vec::new(),
        };
        let mine = marks.iter().filter(|(at, _)| function.contains(*at));
        function.data = mine.copied().collect();
        functions.push(function);
    }
    functions
}

/// Whether a symbol is one of those that a failed check of `core`'s ends in.
pub fn is_panic(symbol: &str) -> bool {
    let parts = "4core9panicking unwrap_failed expect_failed index_fail index_len_fail \
                 index_order_fail len_mismatch_fail panic_already_ rust_begin_unwind";
    parts.split(' ').any(|part| symbol.contains(part))
}

/// Whether a symbol is f64 arithmetic of the compiler's runtime, or a sine, cosine or tangent of
/// libm: the f32 functions of libm's compute in f64 inside, but for the arc tangent.
pub fn is_f64(symbol: &str) -> bool {
    let has = |parts: &str| parts.split(' ').any(|part| symbol.contains(part));
    let conversions = "__aeabi_f2d __aeabi_i2d __aeabi_ui2d __aeabi_l2d __aeabi_ul2d";
    let runtime = symbol.starts_with("__aeabi_d")
        || conversions.split(' ').any(|name| name == symbol)
        || (symbol.starts_with("__") && has("df3 df2 dfsi"));
    let trig = "sin cos tan rem_pio2";
    let plain = symbol.strip_suffix('f').unwrap_or(symbol);
    runtime
        || trig.split(' ').any(|f| f == plain)
        || (symbol.contains("libm") && has(trig) && !symbol.contains("atan"))
}
