// Compiled to get the precompiled header that the test programs share; it defines nothing.
