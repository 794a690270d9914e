# A bare Cortex-M7 with a double-precision FPU: the Arm MPS2+ board with image AN500, as QEMU has it. A linker script and the
# start-up come from the program (tests/cross/cortex_m7/).
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m7)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(cpu "-mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard -ffunction-sections -fdata-sections -Wno-psabi")
# int32_t is int, as on the other CPUs, and not long: the same overloads, deductions and formats.
string(APPEND cpu " -U__INT32_TYPE__ -D__INT32_TYPE__=int -U__UINT32_TYPE__ '-D__UINT32_TYPE__=unsigned int'")
set(CMAKE_C_FLAGS_INIT "${cpu}")
set(CMAKE_CXX_FLAGS_INIT "${cpu} -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-use-cxa-atexit")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostartfiles -Wl,--gc-sections -Wl,--fatal-warnings")
set(CMAKE_CROSSCOMPILING_EMULATOR
    qemu-system-arm -machine mps2-an500 -display none -monitor none -serial none 
    -chardev stdio,id=out -semihosting-config enable=on,target=native,chardev=out -kernel)
