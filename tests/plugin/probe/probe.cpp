// A second plugin for tests: it reports over a local socket what is where in the window.
//
// Each line is a JSON object: a request or its answer. The probe only looks and measures. Mouse and keyboard
// events are sent by the test through the X server, like those of an artist.
#include "sightings.h"
#include "stalls.h"

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QElapsedTimer>
#include <QGenericPlugin>
#include <QJsonArray>
#include <QJsonDocument>
#include <QLabel>
#include <QLocalServer>
#include <QLocalSocket>
#include <QMenu>
#include <QMetaProperty>
#include <QMouseEvent>
#include <QTransform>
#include <QWidget>

#include <memory>

namespace
{

QObject* named(const QString& name)
{
    for (QWidget* top : QApplication::topLevelWidgets())
    {
        if (top->objectName() == name)
            return top;
        if (auto* found = top->findChild<QObject*>(name))
            return found;
    }
    // Some actions belong to menus, not to the window.
    for (const QWidget* widget : QApplication::allWidgets())
        for (QAction* action : widget->actions())
            if (action->objectName() == name)
                return action;
    return qApp->findChild<QObject*>(name);
}

/// The first visible widget of a class, for widgets without a name.
QWidget* ofClass(const QString& name)
{
    for (QWidget* widget : QApplication::allWidgets())
        if (QLatin1String(widget->metaObject()->className()) == name && widget->isVisible())
            return widget;
    return nullptr;
}

QJsonValue toJson(const QVariant& value)
{
    if (value.canConvert<QTransform>() && value.userType() == qMetaTypeId<QTransform>())
    {
        const auto t = value.value<QTransform>();
        return QJsonArray{t.m11(), t.m12(), t.m21(), t.m22(), t.dx(), t.dy()};
    }
    return QJsonValue::fromVariant(value);
}

QJsonObject describe(QObject* object)
{
    QJsonObject description{{QStringLiteral("class"), QLatin1String(object->metaObject()->className())}};
    const auto* meta = object->metaObject();
    QJsonObject properties;
    for (int i = 0; i < meta->propertyCount(); ++i)
    {
        const QMetaProperty property = meta->property(i);
        if (property.isReadable())
            properties.insert(QLatin1String(property.name()), toJson(property.read(object)));
    }
    for (const QByteArray& name : object->dynamicPropertyNames())
        properties.insert(QString::fromLatin1(name), toJson(object->property(name.constData())));
    description.insert(QStringLiteral("properties"), properties);
    if (auto* widget = qobject_cast<QWidget*>(object))
    {
        const QPoint corner = widget->mapToGlobal(QPoint(0, 0));
        description.insert(QStringLiteral("rect"),
                           QJsonArray{corner.x(), corner.y(), widget->width(), widget->height()});
        description.insert(QStringLiteral("seen"), widget->isVisible() && !widget->visibleRegion().isEmpty());
    }
    return description;
}

/// The time from a mouse move on the canvas to the paint event that shows its picture. Uses the properties
/// "sentRevision" and "shownRevision" of Studio.
class Latency : public QObject
{
public:
    QJsonArray taken;

    bool eventFilter(QObject* watched, QEvent* event) override
    {
        if (event->type() == QEvent::MouseMove && mCanvas && watched == mCanvas)
        {
            const auto* move = static_cast<QMouseEvent*>(event);
            if ((move->buttons() & Qt::LeftButton) != 0)
                QMetaObject::invokeMethod(
                    this, [this] { moved(); }, Qt::QueuedConnection);
        }
        else if (event->type() == QEvent::Paint && mTool && mWaiting)
            QMetaObject::invokeMethod(
                this, [this] { painted(); }, Qt::QueuedConnection);
        return false;
    }

    void watch(QWidget* canvas, QObject* tool)
    {
        mCanvas = canvas;
        mTool = tool;
        taken = {};
        mWaiting = false;
    }

private:
    void moved()
    {
        if (mWaiting || !mTool)
            return;
        mWanted = mTool->property("sentRevision").toULongLong();
        mWaiting = true;
        mSince.start();
    }

    void painted()
    {
        if (mTool->property("shownRevision").toULongLong() < mWanted)
            return;
        mWaiting = false;
        taken.append(double(mSince.nsecsElapsed()) / 1e6);
    }

    QWidget* mCanvas = nullptr;
    QObject* mTool = nullptr;
    bool mWaiting = false;
    quint64 mWanted = 0;
    QElapsedTimer mSince;
};

class Probe : public QObject
{
public:
    explicit Probe(const QString& name) : mStalls(this), mSightings(this)
    {
        connect(&mServer, &QLocalServer::newConnection, this, &Probe::serve);
        mServer.listen(name);
    }

private:
    void serve()
    {
        QLocalSocket* socket = mServer.nextPendingConnection();
        connect(socket, &QLocalSocket::readyRead, this,
                [this, socket]
                {
                    while (socket->canReadLine())
                    {
                        const auto request = QJsonDocument::fromJson(socket->readLine()).object();
                        socket->write(QJsonDocument(answer(request)).toJson(QJsonDocument::Compact) + '\n');
                    }
                });
        connect(socket, &QLocalSocket::disconnected, socket, &QObject::deleteLater);
    }

    QJsonObject answer(const QJsonObject& request)
    {
        const QString command = request.value(QStringLiteral("do")).toString();
        const QString name = request.value(QStringLiteral("name")).toString();
        if (command == QLatin1String("find"))
        {
            QObject* object = named(name);
            return object ? describe(object) : QJsonObject();
        }
        if (command == QLatin1String("class"))
        {
            QWidget* widget = ofClass(name);
            return widget ? describe(widget) : QJsonObject();
        }
        if (command == QLatin1String("names"))
            return names(name);
        if (command == QLatin1String("trigger"))
        {
            auto* action = qobject_cast<QAction*>(named(name));
            // Queued, because an action that opens a dialog would not return.
            if (action)
                QMetaObject::invokeMethod(action, &QAction::trigger, Qt::QueuedConnection);
            auto* button = qobject_cast<QAbstractButton*>(named(name));
            if (button)
                QMetaObject::invokeMethod(button, &QAbstractButton::click, Qt::QueuedConnection);
            return {{QStringLiteral("done"), action || button}};
        }
        if (command == QLatin1String("set"))
        {
            QObject* object = named(name);
            const auto property = request.value(QStringLiteral("property")).toString().toLatin1();
            const QVariant value = request.value(QStringLiteral("value")).toVariant();
            return {{QStringLiteral("done"), object && object->setProperty(property.constData(), value)}};
        }
        if (command == QLatin1String("open"))
        {
            const QString path = request.value(QStringLiteral("path")).toString();
            return {{QStringLiteral("done"),
                     QMetaObject::invokeMethod(qApp, "openFileRequested", Qt::QueuedConnection,
                                               Q_ARG(QString, path))}};
        }
        if (command == QLatin1String("entries"))
            return entries(qobject_cast<QMenu*>(named(name)));
        if (command == QLatin1String("stalls"))
        {
            const QJsonObject report = mStalls.report();
            mStalls.reset();
            return report;
        }
        if (command == QLatin1String("latency"))
        {
            const QJsonArray taken = mLatency.taken;
            mLatency.watch(ofClass(QStringLiteral("ScribbleArea")), named(name));
            qApp->installEventFilter(&mLatency);
            return {{QStringLiteral("milliseconds"), taken}};
        }
        if (command == QLatin1String("watch"))
        {
            const QJsonArray taken = mSightings.taken();
            QVector<QColor> colours;
            for (const QJsonValue colour : request.value(QStringLiteral("colours")).toArray())
                colours.append(QColor(colour.toString()));
            mSightings.watch(colours.isEmpty() ? nullptr : ofClass(name), colours);
            return {{QStringLiteral("taken"), taken}};
        }
        if (command == QLatin1String("grab"))
        {
            auto* widget = qobject_cast<QWidget*>(named(name));
            if (!widget)
                widget = ofClass(name);
            const QString path = request.value(QStringLiteral("path")).toString();
            return {{QStringLiteral("done"), widget && widget->grab().save(path)}};
        }
        return {{QStringLiteral("error"), QStringLiteral("what is \"%1\"?").arg(command)}};
    }

    /// The place of each entry of an open menu on the screen, by its text.
    static QJsonObject entries(const QMenu* menu)
    {
        QJsonObject found;
        if (menu != nullptr && menu->isVisible())
            for (QAction* action : menu->actions())
            {
                const QRect place = menu->actionGeometry(action);
                const QPoint corner = menu->mapToGlobal(place.topLeft());
                found.insert(action->text(),
                             QJsonArray{corner.x(), corner.y(), place.width(), place.height()});
            }
        return found;
    }

    /// Object names that begin with `prefix`, and whether each is a visible widget.
    static QJsonObject names(const QString& prefix)
    {
        QJsonObject found;
        for (QWidget* top : QApplication::topLevelWidgets())
            for (QObject* object : top->findChildren<QObject*>())
                if (object->objectName().startsWith(prefix))
                {
                    const auto* widget = qobject_cast<QWidget*>(object);
                    found.insert(object->objectName(), widget && widget->isVisible());
                }
        return found;
    }

    QLocalServer mServer;
    Stalls mStalls;
    Sightings mSightings;
    Latency mLatency;
};

} // namespace

class ProbePlugin : public QGenericPlugin
{
    Q_OBJECT
    Q_PLUGIN_METADATA(IID QGenericPluginFactoryInterface_iid FILE "probe.json")

public:
    QObject* create(const QString& key, const QString&) override
    {
        const QString name = QString::fromLocal8Bit(qgetenv("LAMPBLACK_PROBE"));
        if (key != QLatin1String("lampblackprobe") || name.isEmpty())
            return nullptr;
        // Queued, because the application object is still being created.
        QMetaObject::invokeMethod(
            qApp, [this, name] { mProbe = std::make_unique<Probe>(name); }, Qt::QueuedConnection);
        return new QObject; // Qt deletes it
    }

private:
    std::unique_ptr<QObject> mProbe;
};

#include "probe.moc"
