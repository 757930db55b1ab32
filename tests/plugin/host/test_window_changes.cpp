// What the host changes in the program's window: its menus, its title, its docks.
#include "host/pencil2d_host.h"
#include "imitation.h"

#include <QMenuBar>
#include <QShortcutEvent>
#include <QTest>

using namespace lampblack;

class WindowChanges : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void anotherProjectAsksFirst()
    {
        const auto window = bareWindow();
        QMenu* file = window->menuBar()->addMenu(QStringLiteral("&File"));
        file->setObjectName(QStringLiteral("menuFile"));
        int left = 0;
        const auto add = [&](QMenu* menu, const char* name)
        {
            QAction* action = menu->addAction(QLatin1String(name));
            action->setObjectName(QLatin1String(name));
            connect(action, &QAction::triggered, window.get(), [&left] { ++left; });
            return action;
        };
        QAction* open = add(file, "actionOpen");
        open->setShortcut(QKeySequence::Open);
        auto* recent = new RecentFileMenu;
        file->addMenu(recent);
        add(recent, "walk.pclx");
        recent->addSeparator();
        add(recent, "clear");
        const std::unique_ptr<Host> host(createHost(nullptr));
        QVERIFY(host != nullptr);
        int asked = 0;
        bool may = false;
        host->guardLeaving(
            [&]
            {
                ++asked;
                return may;
            });
        const auto choose = [&](QMenu* menu, int entry)
        {
            menu->popup({});
            for (int down = 0; down <= entry; ++down)
                QTest::keyClick(menu, Qt::Key_Down);
            QTest::keyClick(menu, Qt::Key_Return);
            QCoreApplication::processEvents();
        };
        for (const bool agreed : {false, true})
        {
            may = agreed;
            const int before = left;
            choose(file, 0);
            QShortcutEvent shortcut(open->shortcut(), 0);
            QCoreApplication::sendEvent(open, &shortcut);
            choose(recent, 0);
            QCOMPARE(left, before + (agreed ? 3 : 0));
        }
        QCOMPARE(asked, 6);
        choose(recent, 1);
        QCOMPARE(left, 4);
        QCOMPARE(asked, 6);
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        QVERIFY(open->isVisible());
        QCOMPARE(file->actions().size(), 2);
    }

    void theTitleMarksALightThatIsNotSaved()
    {
        const auto window = bareWindow();
        window->setWindowTitle(QStringLiteral("[*]/home/ann/walk.pclx"));
        const std::unique_ptr<Host> host(createHost(nullptr));
        host->markModified(true);
        QCOMPARE(window->windowTitle(), QStringLiteral("[*]*/home/ann/walk.pclx"));
        QVERIFY2(!host->isModified(), "the drawings are saved");
        QCOMPARE(host->projectPath(), QStringLiteral("/home/ann/walk.pclx"));
        window->setWindowModified(true);
        QCOMPARE(window->windowTitle(), QStringLiteral("[*]/home/ann/walk.pclx"));
        window->setWindowModified(false);
        window->setWindowTitle(QStringLiteral("[*]/home/ann/run.pclx"));
        QCOMPARE(window->windowTitle(), QStringLiteral("[*]*/home/ann/run.pclx"));
        QTest::qWait(300);
        QCOMPARE(host->projectPath(), QStringLiteral("/home/ann/run.pclx"));
        host->markModified(false);
        QCOMPARE(window->windowTitle(), QStringLiteral("[*]/home/ann/run.pclx"));
    }

    void theMenuSaysLight()
    {
        const auto window = bareWindow();
        QMenu* animation = window->menuBar()->addMenu(QStringLiteral("Animation"));
        animation->setObjectName(QStringLiteral("menuAnimation"));
        animation->addAction(QStringLiteral("Flip Rolling"));
        QAction render(QStringLiteral("Render All Frames"));
        {
            const std::unique_ptr<Host> host(createHost(nullptr));
            host->addLightAction(&render);
            const QList<QAction*> entries = animation->actions();
            QCOMPARE(entries.size(), 3);
            QVERIFY(entries[1]->isSeparator());
            QCOMPARE(entries[2]->text(), QStringLiteral("Light"));
            QCOMPARE(entries[2]->menu()->actions(), QList<QAction*>{&render});
        }
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        QCOMPARE(animation->actions().size(), 1);
    }

    void aDockOfOursFitsAndComesBackAsItWasLeft()
    {
        const auto window = bareWindow();
        auto* palette = new ColorPaletteWidget;
        palette->setObjectName(QStringLiteral("palette"));
        palette->setWidget(new QWidget);
        window->addDockWidget(Qt::RightDockWidgetArea, palette);
        palette->show();
        const auto ours = []
        {
            auto* dock = new QDockWidget(QStringLiteral("Materials"));
            dock->setObjectName(QStringLiteral("lampblack.materials"));
            dock->setWidget(new QWidget);
            dock->widget()->setMinimumHeight(200);
            return dock;
        };
        QByteArray left;
        {
            const int before = window->minimumSizeHint().height();
            const std::unique_ptr<Host> host(createHost(nullptr));
            const std::unique_ptr<QDockWidget> dock(ours());
            host->addDock(dock.get());
            QCoreApplication::processEvents();
            QVERIFY(window->tabifiedDockWidgets(palette).contains(dock.get()));
            QVERIFY(window->minimumSizeHint().height() < before + 300);
            dock->close();
            left = window->saveState();
        }
        window->restoreState(left); // before the plugin is there
        const std::unique_ptr<Host> host(createHost(nullptr));
        const std::unique_ptr<QDockWidget> dock(ours());
        host->addDock(dock.get());
        QVERIFY2(dock->isHidden(), "it was closed");
    }
};

QTEST_MAIN(WindowChanges)
#include "test_window_changes.moc"
