// The library as WebAssembly: requests and answers as JSON.

/// The bytes of an element whose text is base64 of gzip.
export async function unpacked(id) {
  const text = document.getElementById(id).textContent.trim();
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export class LibraryError extends Error {}

/// A started library. A trap (a stack that is too small for a hostile file) leaves it as new.
export class Library {
  static async load(bytes) {
    const library = new Library();
    library.module = await WebAssembly.compile(bytes);
    await library.start();
    return library;
  }

  async start() {
    this.exports = (await WebAssembly.instantiate(this.module, {})).exports;
  }

  /// The answer to a request; throws a LibraryError with the library's words.
  call(request) {
    const bytes = new TextEncoder().encode(JSON.stringify(request));
    const { memory, reserve, call, answer } = this.exports;
    const at = reserve(bytes.length);
    new Uint8Array(memory.buffer, at, bytes.length).set(bytes);
    let length;
    try {
      length = call();
    } catch (trap) {
      // Synchronous: the module is compiled, and the next request must find it working.
      this.exports = new WebAssembly.Instance(this.module, {}).exports;
      throw new LibraryError(`the library stopped at this input (${trap.message}); it has started again`);
    }
    const found = JSON.parse(new TextDecoder().decode(new Uint8Array(memory.buffer, answer(), length)));
    if (found && found.error !== undefined) throw new LibraryError(found.error);
    return found;
  }
}
