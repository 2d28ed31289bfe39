// SPDX-License-Identifier: GPL-2.0-or-later
// Declaring classes whose code is in the loaded YADE.
#pragma once

#include <boost/archive/detail/iserializer.hpp>
#include <boost/archive/detail/oserializer.hpp>

// In the class: what every serialisable class overrides.
#define YADE_ABI_STOCK(K)                                                                                                   \
public:                                                                                                                     \
    ~K() override;                                                                                                          \
    string getBaseClassName(unsigned int = 0) const override;                                                               \
    int getBaseClassNumber() const override;                                                                                \
    string getClassName() const override;                                                                                   \
    void pySetAttr(const string&, const py::object&) override;                                                              \
    py::dict pyDict() const override;                                                                                       \
    void callPostLoad() override;                                                                                           \
    void pyRegisterClass(py::object) override;

// After the class, in namespace yade: its size, its name in archives, and YADE's own code to load and save its part of an archive.
#define YADE_ABI_STOCK_END(K, size)                                                                                         \
    static_assert(sizeof(K) == size, "YADE 2023.02a: size of " #K);                                                         \
    }                                                                                                                       \
    BOOST_CLASS_EXPORT_KEY(yade::K)                                                                                         \
    YADE_ABI_STOCK_SAVE(K, xml_oarchive)                                                                                    \
    YADE_ABI_STOCK_SAVE(K, binary_oarchive)                                                                                 \
    YADE_ABI_STOCK_LOAD(K, xml_iarchive)                                                                                    \
    YADE_ABI_STOCK_LOAD(K, binary_iarchive)                                                                                 \
    namespace yade {
#define YADE_ABI_STOCK_SAVE(K, Archive)                                                                                     \
    extern template void boost::archive::detail::oserializer<boost::archive::Archive, yade::K>::save_object_data(           \
        boost::archive::detail::basic_oarchive&, const void*) const;
#define YADE_ABI_STOCK_LOAD(K, Archive)                                                                                     \
    extern template void boost::archive::detail::iserializer<boost::archive::Archive, yade::K>::load_object_data(           \
        boost::archive::detail::basic_iarchive&, void*, const unsigned int) const;
