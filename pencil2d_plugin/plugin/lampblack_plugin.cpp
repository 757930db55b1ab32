// The entry point: Qt loads this plugin into Pencil2D if QT_QPA_GENERIC_PLUGINS names "lampblack".
#include "host/host.h"
#include "plugin/studio.h"
#include "worker/worker_session.h"

#include <QApplication>
#include <QEvent>
#include <QGenericPlugin>
#include <QMainWindow>

namespace lampblack
{

/// Waits for the main window: Qt creates plugins before there is one.
class WindowWatch : public QObject
{
public:
    bool eventFilter(QObject* watched, QEvent* event) override
    {
        if (event->type() == QEvent::Show && qobject_cast<QMainWindow*>(watched) != nullptr)
        {
            qApp->removeEventFilter(this);
            // Queued, so that the window is painted first and Pencil2D starts as fast as without us.
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
        // Our widgets are destroyed with the window. What refers to them must be destroyed before.
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
        // No parent, because Qt deletes the returned object itself.
        auto* watch = new WindowWatch;
        qApp->installEventFilter(watch);
        return watch;
    }
};

} // namespace lampblack

#include "lampblack_plugin.moc"
