// Of a section's slot: around the eye, drawn without a test.
const uint kAlways = 1u << 31;
// For so many frames a section counts as seen before its box is tested again, each section in a frame of its own.
const uint kFrames = 6u;

bool seen_lately(uint last, uint now) { return now - last <= kFrames; }
bool tested_again(uint slot, uint now) { return (slot + now) % kFrames == 0u; }
