// SPDX-License-Identifier: GPL-2.0-or-later
// Defining a plugin's class. An attribute is ((type, name, initial value, flags, "meaning [unit]")).
#pragma once

#include <lib/pyutil/raw_constructor.hpp>
#include <lib/serialization/Serializable.hpp>

#include <type_traits>

namespace yade::abi {

// Vectors and the like reach Python by reference, so that o.v[0] = 1 changes the object; all else by value.
template <class T> struct ByReference : std::false_type {
};
template <> struct ByReference<Vector2i> : std::true_type {
};
template <> struct ByReference<Vector2r> : std::true_type {
};
template <> struct ByReference<Vector3i> : std::true_type {
};
template <> struct ByReference<Vector3r> : std::true_type {
};
template <> struct ByReference<Quaternionr> : std::true_type {
};
template <> struct ByReference<Matrix3r> : std::true_type {
};

// What Python calls for K(name=value, ...).
template <class K> shared_ptr<K> createFromKeywords(py::tuple args, py::dict keywords)
{
    shared_ptr<K> made(new K);
    made->pyHandleCustomCtorArgs(args, keywords);
    if (py::len(args) > 0) throw runtime_error(made->getClassName() + " takes keyword arguments only.");
    made->pyUpdateAttrs(keywords);
    return made;
}

// An attribute is a member, or static: shared by all objects of the class.
template <class K, class T, class C> auto& valueOf(K& object, T C::*attribute) { return object.*attribute; }
template <class K, class T> T& valueOf(K&, T* attribute) { return *attribute; }

// The four things done with each attribute of an object.

template <class K> struct SetByName {
    K& object;
    const string& key;
    const py::object& value;
    bool done = false;
    template <class Attribute> void operator()(const char* name, Attribute attribute, int, const char*)
    {
        if (done || key != name) return;
        auto& held = valueOf(object, attribute);
        held = py::extract<std::decay_t<decltype(held)>>(value)();
        done = true;
    }
};

template <class K> struct CollectValues {
    const K& object;
    py::dict& values;
    template <class Attribute> void operator()(const char* name, Attribute attribute, int flags, const char*)
    {
        if (!(flags & Attr::hidden)) values[name] = py::object(valueOf(object, attribute));
    }
};

template <class K, class Archive> struct Archived {
    K& object;
    Archive& archive;
    template <class Attribute> void operator()(const char* name, Attribute attribute, int flags, const char*)
    {
        if (!(flags & Attr::noSave)) archive& boost::serialization::make_nvp(name, valueOf(object, attribute));
    }
};

template <class K, class PyClass> struct Exposed {
    PyClass& shown;
    template <class T, class C> void operator()(const char* name, T C::*attribute, int flags, const char* doc)
    {
        if (flags & Attr::hidden) return;
        const string text = string(doc) + " :yattrflags:`" + std::to_string(flags) + "` ";
        const auto get = getter(attribute);
        const auto set = [attribute](K& object, const T& value) { object.*attribute = value; };
        const auto reload = [attribute](K& object, const T& value) {
            object.*attribute = value;
            object.callPostLoad();
        };
        using Setter = boost::mpl::vector3<void, K&, const T&>;
        if (flags & Attr::readonly)
            shown.add_property(name, get, text.c_str());
        else if (flags & Attr::triggerPostLoad)
            shown.add_property(name, get, py::make_function(reload, py::default_call_policies(), Setter()), text.c_str());
        else
            shown.add_property(name, get, py::make_function(set, py::default_call_policies(), Setter()), text.c_str());
    }
    /// Static; Boost keeps no text for these, the class's own has it.
    template <class T> void operator()(const char* name, T* attribute, int flags, const char*)
    {
        if (flags & Attr::readonly)
            shown.def_readonly(name, attribute);
        else if (!(flags & Attr::hidden))
            shown.def_readwrite(name, attribute);
    }
    template <class T, class C> static py::object getter(T C::*attribute)
    {
        if constexpr (ByReference<T>::value)
            return py::make_getter(attribute, py::return_internal_reference<>());
        else
            return py::make_getter(attribute, py::return_value_policy<py::return_by_value>());
    }
};

} // namespace yade::abi

#define YADE_CLASS_BASE_DOC(K, Base, doc) YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(K, Base, doc, , , , )
#define YADE_CLASS_BASE_DOC_ATTRS(K, Base, doc, attrs) YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(K, Base, doc, attrs, , , )
#define YADE_CLASS_BASE_DOC_ATTRS_CTOR(K, Base, doc, attrs, ctor)                                                           \
    YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(K, Base, doc, attrs, , ctor, )
#define YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(K, Base, doc, attrs, ctor, py)                                                    \
    YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(K, Base, doc, attrs, , ctor, py)
#define YADE_CLASS_BASE_DOC_ATTRS_DEPREC_INIT_CTOR_PY(K, Base, doc, attrs, deprecated, inits, ctor, py)                     \
    static_assert(BOOST_PP_SEQ_SIZE(deprecated) == 0, "a new class has no deprecated attributes");                          \
    YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(K, Base, doc, attrs, inits, ctor, py)

// inits: ((member, value))... for members that are no attributes; ctor: statements of the constructor; py: .def(...) and the like.
#define YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(K, Base, doc, attrs, inits, ctor, py)                                        \
public:                                                                                                                     \
    BOOST_PP_SEQ_FOR_EACH(YADE_ABI_ATTR_MEMBER, ~, attrs)                                                                   \
    K() BOOST_PP_IF(BOOST_PP_SEQ_SIZE(inits), :, ) BOOST_PP_SEQ_FOR_EACH_I(YADE_ABI_INIT, ~, inits) { ctor; }               \
    YADE_ABI_CLASS(K, Base, doc, attrs, , py)

// Of attributes that all objects share; the source file has to define them, and they get their initial values at registration.
#define YADE_CLASS_BASE_DOC_STATICATTRS(K, Base, doc, attrs)                                                                \
public:                                                                                                                     \
    BOOST_PP_SEQ_FOR_EACH(YADE_ABI_STATIC_MEMBER, ~, attrs)                                                                 \
    K() { }                                                                                                                 \
    YADE_ABI_CLASS(K, Base, doc "\n\n" BOOST_PP_SEQ_FOR_EACH(YADE_ABI_STATIC_DOC, K, attrs), attrs,                         \
                   BOOST_PP_SEQ_FOR_EACH(YADE_ABI_STATIC_INIT, K, attrs), )

#define YADE_ABI_CLASS(K, Base, doc, attrs, atRegistration, py)                                                             \
    REGISTER_CLASS_AND_BASE(K, Base)                                                                                        \
                                                                                                                            \
    template <class Visitor> static void eachAttribute([[maybe_unused]] Visitor& visit)                                     \
    {                                                                                                                       \
        BOOST_PP_SEQ_FOR_EACH(YADE_ABI_ATTR_VISIT, K, attrs)                                                                \
    }                                                                                                                       \
    void pySetAttr(const std::string& key, const ::boost::python::object& value) override                                   \
    {                                                                                                                       \
        ::yade::abi::SetByName<K> set { *this, key, value };                                                                \
        eachAttribute(set);                                                                                                 \
        if (!set.done) Base::pySetAttr(key, value);                                                                         \
    }                                                                                                                       \
    ::boost::python::dict pyDict() const override                                                                           \
    {                                                                                                                       \
        ::boost::python::dict values;                                                                                       \
        ::yade::abi::CollectValues<K> collect { *this, values };                                                            \
        eachAttribute(collect);                                                                                             \
        values.update(this->pyDictCustom());                                                                                \
        values.update(Base::pyDict());                                                                                      \
        return values;                                                                                                      \
    }                                                                                                                       \
    void callPostLoad() override                                                                                            \
    {                                                                                                                       \
        Base::callPostLoad();                                                                                               \
        postLoad(*this);                                                                                                    \
    }                                                                                                                       \
    void pyRegisterClass(::boost::python::object where) override                                                            \
    {                                                                                                                       \
        checkPyClassRegistersItself(#K);                                                                                    \
        atRegistration const ::boost::python::scope in(where);                                                              \
        const ::boost::python::docstring_options shownDocs(true, true, false);                                              \
        using Shown                                                                                                         \
            = ::boost::python::class_<K, ::boost::shared_ptr<K>, ::boost::python::bases<Base>, ::boost::noncopyable>;       \
        Shown shown(#K, doc);                                                                                               \
        shown.def("__init__", ::yade::abi::KeywordConstructor::make(::yade::abi::createFromKeywords<K>));                   \
        ::yade::abi::Exposed<K, Shown> expose { shown };                                                                    \
        eachAttribute(expose);                                                                                              \
        (void)shown py;                                                                                                     \
    }                                                                                                                       \
                                                                                                                            \
private:                                                                                                                    \
    friend class boost::serialization::access;                                                                              \
    template <class ArchiveT> void serialize(ArchiveT& archive, unsigned int)                                               \
    {                                                                                                                       \
        archive& boost::serialization::make_nvp(#Base, boost::serialization::base_object<Base>(*this));                     \
        if (ArchiveT::is_loading::value)                                                                                    \
            preLoad(*this);                                                                                                 \
        else                                                                                                                \
            preSave(*this);                                                                                                 \
        ::yade::abi::Archived<K, ArchiveT> each { *this, archive };                                                         \
        eachAttribute(each);                                                                                                \
        if (ArchiveT::is_loading::value)                                                                                    \
            postLoad(*this);                                                                                                \
        else                                                                                                                \
            postSave(*this);                                                                                                \
    }                                                                                                                       \
                                                                                                                            \
public:

#define YADE_ABI_ATTR(i, a) BOOST_PP_TUPLE_ELEM(5, i, a)
#define YADE_ABI_ATTR_MEMBER(r, _, a)                                                                                       \
    YADE_ABI_ATTR(0, a) YADE_ABI_ATTR(1, a) = decltype(YADE_ABI_ATTR(1, a))(YADE_ABI_ATTR(2, a));
#define YADE_ABI_STATIC_MEMBER(r, _, a) static YADE_ABI_ATTR(0, a) YADE_ABI_ATTR(1, a);
#define YADE_ABI_STATIC_INIT(r, K, a) K::YADE_ABI_ATTR(1, a) = YADE_ABI_ATTR(2, a);
#define YADE_ABI_STATIC_DOC(r, K, a)                                                                                        \
    ".. ystaticattr:: " BOOST_PP_STRINGIZE(K) "." BOOST_PP_STRINGIZE(YADE_ABI_ATTR(1, a)) "(=" BOOST_PP_STRINGIZE(          \
        YADE_ABI_ATTR(2, a)) ")\n\n\t" YADE_ABI_ATTR(4, a) "\n\n"
#define YADE_ABI_ATTR_VISIT(r, K, a)                                                                                        \
    visit(BOOST_PP_STRINGIZE(YADE_ABI_ATTR(1, a)), &K::YADE_ABI_ATTR(1, a), (YADE_ABI_ATTR(3, a) + 0),                      \
          YADE_ABI_ATTR(4, a) " :ydefault:`" BOOST_PP_STRINGIZE(YADE_ABI_ATTR(2, a)) "` :yattrtype:`" BOOST_PP_STRINGIZE(   \
              YADE_ABI_ATTR(0, a)) "`");
#define YADE_ABI_INIT(r, _, i, pair) BOOST_PP_COMMA_IF(i) BOOST_PP_TUPLE_ELEM(2, 0, pair)(BOOST_PP_TUPLE_ELEM(2, 1, pair))

// After a class, in namespace yade: makes it known to the factory and gives its archives the name yade::K.
#define REGISTER_SERIALIZABLE(K)                                                                                            \
    REGISTER_FACTORABLE(K)                                                                                                  \
    }                                                                                                                       \
    BOOST_CLASS_EXPORT_KEY(yade::K)                                                                                         \
    namespace yade {
