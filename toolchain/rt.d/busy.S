/* What the guest runs when there is nothing to do. The emulator's two threads race over the clock whenever the processor halts, so
   that a busy host moves the guest's interrupts; a processor that never halts leaves the clock to one of them. A straight run of
   instructions costs the emulator as good as nothing. */
.globl _start
_start:
  .rept 500
  nop
  .endr
  jmp _start
.section .note.GNU-stack, "", @progbits
