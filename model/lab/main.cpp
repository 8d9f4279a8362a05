#include "model/lab/lab.h"

int main(int argc, char** argv) { return choreo::RunLab(argc, argv); }
