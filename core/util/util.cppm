// The tools of all stages: messages, files, memory, texts.
export module candela.util;

export import :arrays;
export import :canary;
export import :diagnostics;
export import :files;
export import :memory;
export import :simd;
export import :text;
