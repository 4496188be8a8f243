flat in uint number;
layout(location = 0) out uint shown;

void main() { shown = number + 1u; }
