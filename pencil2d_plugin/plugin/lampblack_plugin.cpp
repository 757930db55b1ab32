// The way in: Qt loads this into Pencil2D when QT_QPA_GENERIC_PLUGINS names "lampblack".
#include "host/host.h"
#include "plugin/studio.h"
#include "worker/worker_session.h"

#include <QApplication>
#include <QEvent>
#include <QGenericPlugin>
#include <QMainWindow>

namespace lampblack
{

/// Waits for the main window: plugins are made before there is any.
class WindowWatch : public QObject
{
public:
    bool eventFilter(QObject* watched, QEvent* event) override
    {
        if (event->type() == QEvent::Show && qobject_cast<QMainWindow*>(watched) != nullptr)
        {
            qApp->removeEventFilter(this);
            // Once the window is up and painted: a start that is not ours to slow down.
            QMetaObject::invokeMethod(this, &WindowWatch::begin, Qt::QueuedConnection);
        }
        return false;
    }

private:
    void begin()
    {
        Host* host = createHost(qApp);
        if (host == nullptr)
            return;
        auto* studio = new Studio(*host, std::make_unique<WorkerSession>(), qApp);
        // Widgets of ours die with the window: what binds to them must be gone before.
        connect(qApp, &QCoreApplication::aboutToQuit, this,
                [host, studio]
                {
                    delete studio;
                    delete host;
                });
    }
};

class LampblackPlugin : public QGenericPlugin
{
    Q_OBJECT
    Q_PLUGIN_METADATA(IID QGenericPluginFactoryInterface_iid FILE "lampblack.json")

public:
    QObject* create(const QString& key, const QString&) override
    {
        if (key != QLatin1String("lampblack") || qobject_cast<QApplication*>(qApp) == nullptr)
            return nullptr;
        // Qt deletes what we return, last of all: a parent would have done so before.
        auto* watch = new WindowWatch;
        qApp->installEventFilter(watch);
        return watch;
    }
};

} // namespace lampblack

#include "lampblack_plugin.moc"
