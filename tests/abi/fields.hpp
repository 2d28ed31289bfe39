// SPDX-License-Identifier: GPL-2.0-or-later
// A table of the declared classes and their members, through which the self-test reads and writes objects that YADE made.
#pragma once

#include <lib/serialization/Serializable.hpp>

#include <boost/core/demangle.hpp>

#include <functional>
#include <map>
#include <type_traits>

namespace yade::probe {

template <class T> bool equal(const T& a, const T& b) { return a == b; }
template <> inline bool equal(const Quaternionr& a, const Quaternionr& b) { return a.coeffs() == b.coeffs(); }
template <> inline bool equal(const Se3r& a, const Se3r& b)
{
    return a.position == b.position && equal(a.orientation, b.orientation);
}

// An object of class T, by its name: works for classes that the declarations cannot construct.
template <class T> shared_ptr<T> make()
{
    const string name = boost::core::demangle(typeid(T).name());
    return boost::dynamic_pointer_cast<T>(ClassFactory::instance().createShared(name.substr(name.rfind(':') + 1)));
}

// A value that differs from those of other seeds, and in every component.
template <class T> struct Distinct {
    static T value(int seed)
    {
        if constexpr (std::is_same_v<T, bool>)
            return seed % 2;
        else if constexpr (std::is_floating_point_v<T>)
            return seed + 0.25;
        else
            return T(seed + 1);
    }
};
template <> struct Distinct<string> {
    static string value(int seed) { return "text" + std::to_string(seed); }
};
template <class S, int Rows, int Cols> struct Distinct<Eigen::Matrix<S, Rows, Cols>> {
    static Eigen::Matrix<S, Rows, Cols> value(int seed)
    {
        Eigen::Matrix<S, Rows, Cols> m;
        for (int i = 0; i < m.size(); i++)
            m(i / Cols, i % Cols) = Distinct<S>::value(seed + i * i);
        return m;
    }
};
template <> struct Distinct<Quaternionr> {
    static Quaternionr value(int seed) { return Quaternionr(seed, 1, 2, 3); }
};
template <> struct Distinct<Se3r> {
    static Se3r value(int seed) { return Se3r(Distinct<Vector3r>::value(seed), Distinct<Quaternionr>::value(seed)); }
};
template <class T> struct Distinct<shared_ptr<T>> {
    static shared_ptr<T> value(int) { return make<T>(); }
};
template <class T> struct Distinct<vector<T>> {
    static vector<T> value(int seed) { return { Distinct<T>::value(seed), Distinct<T>::value(seed + 1) }; }
};

// One member of a class, with its type forgotten.
struct Field {
    std::function<py::object(int seed)> distinct;
    std::function<bool(py::object self, py::object value)> holds;
    std::function<void(py::object self, py::object value)> write;
    std::function<bool(py::object, py::object)> same;
};

struct Class {
    size_t size;
    std::map<string, Field> fields;
};

using Table = std::map<string, Class>;

template <class T> T taken(const py::object& from)
{
    T value {};
    value = py::extract<T>(from)();
    return value;
}

template <class K, class Access> Field field(Access access)
{
    using T = std::remove_reference_t<decltype(access(std::declval<K&>()))>;
    const auto on = [access](py::object self) -> T& { return access(dynamic_cast<K&>(py::extract<Serializable&>(self)())); };
    return { [](int seed) { return py::object(Distinct<T>::value(seed)); },
             [on](py::object self, py::object value) { return equal(on(self), taken<T>(value)); },
             [on](py::object self, py::object value) { on(self) = taken<T>(value); },
             [](py::object a, py::object b) { return equal(taken<T>(a), taken<T>(b)); } };
}

const Table& table();

} // namespace yade::probe
