// SPDX-License-Identifier: GPL-2.0-or-later
// YADE's log: DECLARE_LOGGER in a class, CREATE_LOGGER(Class) in its source file, then LOG_WARN("x=" << x).
#pragma once

#include <lib/base/Singleton.hpp>

#include <boost/log/sources/record_ostream.hpp>
#include <boost/log/sources/severity_logger.hpp>

#include <iostream>
#include <string>

class Logging : public Singleton<Logging> {
public:
    enum SeverityLevel { eNOFILTER = 0, eFATAL = 1, eERROR = 2, eWARN = 3, eINFO = 4, eDEBUG = 5, eTRACE = 6 };
    using Logger = boost::log::sources::severity_logger<SeverityLevel>;
    Logger createNamedLogger(std::string name);
};

#define DECLARE_LOGGER                                                                                                      \
public:                                                                                                                     \
    static Logging::Logger logger
#define CREATE_LOGGER(Class) Logging::Logger Class::logger = Logging::instance().createNamedLogger(#Class)
#define CREATE_CPP_LOCAL_LOGGER(name)                                                                                       \
    namespace {                                                                                                             \
        Logging::Logger logger = Logging::instance().createNamedLogger(name);                                               \
    }

#define YADE_ABI_LOG(level, msg)                                                                                            \
    {                                                                                                                       \
        BOOST_LOG_SEV(logger, Logging::level) << ":" << __LINE__ << " " << __func__ << ": " << msg;                         \
    }
#define LOG_FATAL(msg) YADE_ABI_LOG(eFATAL, msg)
#define LOG_ERROR(msg) YADE_ABI_LOG(eERROR, msg)
#define LOG_WARN(msg) YADE_ABI_LOG(eWARN, msg)
#define LOG_INFO(msg) YADE_ABI_LOG(eINFO, msg)
#define LOG_DEBUG(msg) YADE_ABI_LOG(eDEBUG, msg)
