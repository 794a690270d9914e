#include "drivers/canopen/sdo_abort.hpp"

namespace ivo::drivers {

std::string_view name_of(SdoAbort code) noexcept {
  switch (code) {
    case SdoAbort::kToggle:
      return "toggle bit not alternated";
    case SdoAbort::kTimeout:
      return "SDO protocol timed out";
    case SdoAbort::kCommandSpecifier:
      return "command specifier not valid or unknown";
    case SdoAbort::kBlockSize:
      return "invalid block size";
    case SdoAbort::kSequenceNumber:
      return "invalid sequence number";
    case SdoAbort::kCrc:
      return "CRC error";
    case SdoAbort::kMemory:
      return "out of memory";
    case SdoAbort::kAccess:
      return "unsupported access to an object";
    case SdoAbort::kWriteOnly:
      return "attempt to read a write-only object";
    case SdoAbort::kReadOnly:
      return "attempt to write a read-only object";
    case SdoAbort::kNoObject:
      return "object does not exist";
    case SdoAbort::kNotMappable:
      return "object cannot be mapped to the PDO";
    case SdoAbort::kPdoLength:
      return "mapped objects exceed PDO length";
    case SdoAbort::kParameterIncompatible:
      return "general parameter incompatibility";
    case SdoAbort::kDeviceIncompatible:
      return "general internal incompatibility in the device";
    case SdoAbort::kHardware:
      return "access failed due to a hardware error";
    case SdoAbort::kLength:
      return "data type does not match, length of service parameter does not match";
    case SdoAbort::kLengthTooHigh:
      return "data type does not match, length of service parameter too high";
    case SdoAbort::kLengthTooLow:
      return "data type does not match, length of service parameter too low";
    case SdoAbort::kNoSubIndex:
      return "sub-index does not exist";
    case SdoAbort::kValueRange:
      return "value range exceeded";
    case SdoAbort::kValueTooHigh:
      return "value written too high";
    case SdoAbort::kValueTooLow:
      return "value written too low";
    case SdoAbort::kMaximumBelowMinimum:
      return "maximum value is less than minimum value";
    case SdoAbort::kResource:
      return "resource not available";
    case SdoAbort::kGeneral:
      return "general error";
    case SdoAbort::kNotStorable:
      return "data cannot be transferred or stored";
    case SdoAbort::kLocalControl:
      return "data cannot be transferred or stored because of local control";
    case SdoAbort::kDeviceState:
      return "data cannot be transferred or stored because of the present device state";
    case SdoAbort::kNoDictionary:
      return "object dictionary is not present";
    case SdoAbort::kNoData:
      return "no data available";
  }
  return "unknown abort code";
}

}  // namespace ivo::drivers
